"""The compiled module over the C++ libraries, imported after the path of the unit tables is set."""

import os
from pathlib import Path

# A wheel has the tables of units beside this file; otherwise udunits2 finds those of the system.
_UNITS = Path(__file__).with_name("units") / "udunits2.xml"
if _UNITS.is_file():
    os.environ.setdefault("UDUNITS2_XML_PATH", str(_UNITS))

from . import _core as core  # noqa: E402

__all__ = ["core"]
