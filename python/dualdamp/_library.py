"""The module over the C++ libraries, with what these need to find."""

import os
from pathlib import Path

# A wheel brings the tables of units along; elsewhere udunits2 knows where they are.
_UNITS = Path(__file__).with_name("units") / "udunits2.xml"
if _UNITS.is_file():
    os.environ.setdefault("UDUNITS2_XML_PATH", str(_UNITS))

from . import _core as core  # noqa: E402

__all__ = ["core"]
