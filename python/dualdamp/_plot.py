"""Charts of results with Matplotlib."""

from __future__ import annotations

# Possible abscissas and ordinates of the chart of a table. The first abscissa that the table has is drawn, and all ordinates that it has.
_CHARTS = {
    "curve": (("Y", "omega"), ("x",)),
    "branch": (("Y", "omega"), ("x",)),
    "history": (("t",), ("x",)),
    "orbit": (("t",), ("x",)),
    "peaks": (("t",), ("x",)),
}


def _label(name, unit):
    return f"{name} [{unit}]" if unit else name


def _chart_of(name, columns):
    """The abscissa and the ordinates of the chart of a table; None: it has no chart."""
    abscissas, ordinates = _CHARTS.get(name, ((), ()))
    first = next((column for column in abscissas if column in columns), None)
    drawn = [column for column in ordinates if column in columns]
    return (first, drawn) if first is not None and drawn else None


def _shown(array, name, shown):
    """A column in the unit in which it is shown."""
    return array[name] * shown[name][1] if array[name].dtype.kind == "f" else array[name]


def draw(result, table, ax):
    from matplotlib import pyplot

    arrays = result.tables
    if table is None:
        table = next((name for name in arrays if name == "map" or _chart_of(name, arrays[name].dtype.names)), None)
    if table is None or table not in arrays:
        raise ValueError(f"a result of {result.analysis} has no {'chart' if table is None else f'table {table!r}'}; tables: {', '.join(arrays) or 'none'}")
    array, shown = arrays[table], result._run.shown_units[table]
    if ax is None:
        ax = pyplot.figure().add_subplot()
    ax.set_title(result.scenario.get("title", result.analysis))
    if table == "map":
        points = ax.scatter(_shown(array, "omega", shown), _shown(array, "Y", shown), c=array["stops"], s=8, marker="s")
        ax.figure.colorbar(points, ax=ax, label="stops in a period")
        first, drawn = "omega", ["Y"]
    else:
        first, drawn = _chart_of(table, array.dtype.names) or (array.dtype.names[0], [name for name in array.dtype.names[1:] if array[name].dtype.kind in "fi"][:1])
        for name in drawn:
            ax.plot(_shown(array, first, shown), _shown(array, name, shown), ".-" if len(array) <= 200 else "-", label=name)
    ax.set_xlabel(_label(first, shown[first][0]))
    ax.set_ylabel(_label(drawn[0], shown[drawn[0]][0]))
    return ax
