"""The pictures of a chart, by matplotlib. Every point of a figure has an id, and `described` tells what it is."""
import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams.update(
    {
        "svg.hashsalt": "ao chart",
        "svg.fonttype": "none",
        "font.family": "DejaVu Sans",
        "font.size": 9,
        "axes.grid": True,
        "grid.color": "#000000",
        "grid.alpha": 0.12,
        "axes.spines.top": False,
        "axes.spines.right": False,
    }
)
import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

import chart_data as data

GREY = "#9a9a9a"
CLOCKS = {clock: unit + " per megapixel" for clock, unit in data.CLOCKS.items()}


def plain_number(x, _):
    return f"{x:g}"


def log_axes(axes, which):
    for name in which:
        axis = axes.xaxis if name == "x" else axes.yaxis
        (axes.set_xscale if name == "x" else axes.set_yscale)("log")
        low, high = axis.get_view_interval()
        subs = (1, 2, 5) if high / max(low, 1e-12) > 6 else (1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9)
        axis.set_major_locator(LogLocator(base=10, subs=subs))
        axis.set_major_formatter(FuncFormatter(plain_number))
        axis.set_minor_formatter(NullFormatter())


class figure:
    """A matplotlib figure with the texts of its points by their ids."""

    def __init__(self, name, title, columns, rows, width, height):
        self.name = name
        self.title = title
        self.texts = {}
        self.figure, axes = plt.subplots(rows, columns, figsize=(width, height), squeeze=False)
        self.axes = [a for line in axes for a in line]

    def point(self, axes, x, y, text, **look):
        key = f"{self.name}-{len(self.texts)}"
        axes.plot([x], [y], linestyle="none", gid=key, **look)
        self.texts[key] = text


def scatter(fig, axes, points, chart, marker=None, y="y"):
    """Front in color with its staircase, what it dominates in grey."""
    kept = data.front(points, y)
    names = {p["name"] for p in kept}
    for p in sorted(points, key=lambda q: q["name"] in names):
        at_front = p["name"] in names
        tint = data.color(p["method"])
        if y == "y":
            bars = {"color": tint if at_front else GREY, "alpha": 0.5 if at_front else 0.25, "linewidth": 0.8, "zorder": 1}
            axes.plot([p["x_low"], p["x_high"]], [p["y"], p["y"]], **bars)
            axes.plot([p["x"], p["x"]], [p["y_low"], p["y_high"]], **bars)
        shape = marker or data.MARKERS.get(p["route"], "o")
        inside = "white" if p["hollow"] else tint if at_front else "#cfcfcf"
        fig.point(
            axes, p["x"], p[y], data.described(p, chart), marker=shape, markersize=6 if at_front else 4.2,
            markerfacecolor=inside, markeredgecolor=tint, markeredgewidth=1 if at_front else 0.6, zorder=3 if at_front else 2,
        )
    if kept:
        end = max(p["x"] for p in points) * 1.15
        xs = [p["x"] for p in kept] + [end]
        ys = [p[y] for p in kept] + [kept[-1][y]]
        axes.step(xs, ys, where="post", color="#333333", linewidth=0.9, zorder=1.5)


def label_front(axes, points, y="y"):
    kept = data.front(points, y)
    for i, p in enumerate(kept):
        right = 3 * i >= 2 * len(kept)  # there is no room to their right
        text = axes.annotate(p["name"], (p["x"], p[y]), textcoords="offset points", xytext=(-3 if right else 3, 5), fontsize=6,
                             color="#333333", rotation=-32 if right else 32, ha="right" if right else "left")
        text.set_in_layout(False)


def method_legend(fig, points, extra=()):
    methods = sorted({p["method"] for p in points}, key=lambda m: list(data.COLORS).index(m) if m in data.COLORS else 99)
    handles = [Line2D([], [], marker="o", linestyle="none", color=data.color(m), label=m) for m in methods]
    handles.append(Line2D([], [], marker="o", linestyle="none", markerfacecolor="#cfcfcf", markeredgecolor=GREY, markersize=4, label="dominated"))
    if any(p["hollow"] for p in points):
        handles.append(Line2D([], [], marker="o", linestyle="none", markerfacecolor="white", markeredgecolor="#333333", label="in a pan"))
    handles += list(extra)
    fig.figure.legend(handles=handles, loc="lower center", ncol=min(len(handles), 9), frameon=False, fontsize=8)


def constant_line(axes, chart):
    constant = data.best_constant(chart)
    if constant:
        axes.axhline(constant, color="#333333", linestyle=":", linewidth=0.9)
        axes.annotate("best constant picture", (0.98, constant), xycoords=("axes fraction", "data"), ha="right", va="bottom", fontsize=7)


def titled(fig, chart, rect=(0, 0.06, 1, 0.95)):
    fig.figure.suptitle(fig.title, x=0.01, ha="left", fontsize=10)
    fig.figure.tight_layout(rect=rect)
    return fig


def time_figure(chart, clock):
    routes = [r["name"] for r in chart["routes"]]
    if not routes:
        return None
    columns = 2 if len(routes) > 1 else 1
    rows = (len(routes) + columns - 1) // columns
    fig = figure("time", f"Error against time, {len(chart['views'])} views at {chart['size'][0]}x{chart['size'][1]}; bars: p10 to p90 over views and frames",
                 columns, rows, 5.6 * columns, 3.9 * rows + 0.5)
    all_points = []
    for axes, route in zip(fig.axes, routes):
        points = data.points_of(chart, route, clock)
        all_points += points
        scatter(fig, axes, points, chart)
        label_front(axes, points)
        constant_line(axes, chart)
        axes.set_title(route, fontsize=9, loc="left")
        axes.set_xlabel(CLOCKS[clock])
        axes.set_ylabel("RMSE against rays")
        log_axes(axes, "xy")
    for axes in fig.axes[len(routes):]:
        axes.set_visible(False)
    low, high = min(p["y_low"] for p in all_points) * 0.93, max([p["y_high"] for p in all_points] + [data.best_constant(chart)]) * 1.07
    for axes in fig.axes[: len(routes)]:
        axes.set_ylim(low, high)
    markers = [Line2D([], [], marker=data.MARKERS.get(r, "o"), linestyle="none", color="#555555", label=r) for r in routes]
    method_legend(fig, all_points, markers)
    return titled(fig, chart)


def cost_figure(chart, clock):
    points = data.points_of(chart, None, clock)
    if not points:
        return None
    fig = figure("cost", "Error against what a frame asks for, counted in the plan and the SPIR-V of its passes", 2, 1, 11.2, 4.5)
    scatter(fig, fig.axes[0], points, chart, "o")
    label_front(fig.axes[0], points)
    fig.axes[0].set_xlabel(f"operations + {data.FETCH} fetches, per pixel")
    by_bytes = [dict(p, x=p["cost"]["bytes"], x_low=p["cost"]["bytes"], x_high=p["cost"]["bytes"]) for p in points]
    scatter(fig, fig.axes[1], by_bytes, chart, "o")
    fig.axes[1].set_xlabel("bytes of pictures read and written once, per pixel")
    for axes in fig.axes:
        constant_line(axes, chart)
        axes.set_ylabel("RMSE against rays")
        log_axes(axes, "xy")
    method_legend(fig, points)
    return titled(fig, chart, (0, 0.07, 1, 0.95))


def flicker_figure(chart, clock):
    routes = [r["name"] for r in chart["routes"] if "fragment" not in r["name"]]
    panels = [(r, [p for p in data.points_of(chart, r, clock) if p["flicker"]]) for r in routes]
    panels = [(r, [p for p in points if p["varies"] != "static"]) for r, points in panels]
    panels = [(r, points) for r, points in panels if points]
    if not panels:
        return None
    fig = figure("flicker", "Flicker in a pan of half a pixel a frame: mean change of a surface point's visibility, against time",
                 len(panels), 1, 4.4 * len(panels), 4.3)
    everything = []
    for axes, (route, points) in zip(fig.axes, panels):
        everything += points
        scatter(fig, axes, points, chart, y="flicker")
        label_front(axes, points, "flicker")
        axes.set_title(route, fontsize=9, loc="left")
        axes.set_xlabel(CLOCKS[clock])
        axes.set_ylabel("flicker")
        log_axes(axes, "xy")
    method_legend(fig, everything)
    return titled(fig, chart, (0, 0.08, 1, 0.94))


def convergence_figure(chart, clock):
    total, sampling = data.convergence(chart, "rmse"), data.convergence(chart, "sampling")
    if not total:
        return None
    fig = figure("convergence", "Error against taps, no filter", 2, 1, 11.2, 4.4)
    for axes, lines, what in ((fig.axes[0], total, "RMSE against rays"), (fig.axes[1], sampling, "RMSE against the same integral with 1024 taps")):
        for method, line in lines.items():
            xs, ys = [x for x, _ in line], [y for _, y in line]
            fitted = data.slope(line, 16)
            label = method if fitted is None or axes is fig.axes[0] else f"{method}: taps^{fitted:.2f} from 16 on"
            axes.plot(xs, ys, color=data.color(method), linewidth=1.2, label=label)
            for x, y in line:
                fig.point(axes, x, y, [f"{method}, {x} taps, no filter", f"{what} {y:.4f}"], marker="o", markersize=4, color=data.color(method))
        axes.set_xlabel("taps")
        axes.set_ylabel(what)
        axes.legend(frameon=False, fontsize=8)
        log_axes(axes, "xy")
        axes.set_xticks([4, 8, 16, 32, 64, 128, 256])
    constant_line(fig.axes[0], chart)
    return titled(fig, chart, (0, 0, 1, 0.95))


def classes_figure(chart, clock):
    """The most exact configuration of every method, by class of pixel."""
    best = {}
    for c in chart["single"]:
        if c["times"] and (c["method"] not in best or c["error"]["rmse"] < best[c["method"]]["rmse"]):
            best[c["method"]] = {"rmse": c["error"]["rmse"], "name": c["name"], "classes": c["error"]["classes"], "method": c["method"]}
    for c in chart["temporal"]:
        seen = [m for m in c["motions"] if m["motion"] == "pan"]
        if not seen:
            continue
        rmse = data.mean(m["rmse"] for m in seen)
        if c["method"] in best and best[c["method"]]["rmse"] <= rmse:
            continue
        squares = {}
        for m in seen:
            for name, part in m["classes"].items():
                sums = squares.setdefault(name, [0, 0.0])
                sums[0] += part["pixels"]
                sums[1] += part["pixels"] * part["rmse"] ** 2
        best[c["method"]] = {"rmse": rmse, "name": c["name"] + ", pan", "method": c["method"],
                             "classes": {name: (s / n) ** 0.5 for name, (n, s) in squares.items()}}
    if not best:
        return None
    order = ["interior", "silhouette", "border", "thin", "disoccluded"]
    order = [k for k in order if any(k in b["classes"] for b in best.values())]
    fig = figure("classes", "Where the error is: RMSE by class of pixel, the most exact configuration of every method", 1, 1, 9, 4)
    axes = fig.axes[0]
    axes.grid(axis="x", visible=False)
    wide = 0.8 / len(best)
    for i, b in enumerate(best.values()):
        for k, name in enumerate(order):
            if name not in b["classes"]:
                continue
            key = f"classes-{len(fig.texts)}"
            bar = axes.bar(k - 0.4 + wide * (i + 0.5), b["classes"][name], wide * 0.92, color=data.color(b["method"]),
                           label=b["name"] if k == 0 else None)
            bar.patches[0].set_gid(key)
            fig.texts[key] = [b["name"], f"{name}: RMSE {b['classes'][name]:.4f}"]
    axes.set_xticks(range(len(order)))
    axes.set_xticklabels(order)
    axes.set_ylabel("RMSE against rays")
    axes.legend(frameon=False, fontsize=8)
    return titled(fig, chart, (0, 0, 1, 0.95))


def vertices_figure(chart, clock):
    found = chart["vertices"]
    if not found:
        return None
    looks = {"lebedev": ("#0072b2", "o"), "fibonacci": ("#e69f00", "P"), "fibonacci-pairs": ("#009e73", "s"), "marsaglia": ("#cc79a7", "X")}
    title = f"Ambient occlusion per vertex: {found['model']}, {found['vertices']} vertices, {found['triangles']} triangles"
    fig = figure("vertices", title, 2, 1, 11.2, 4.4)
    lines = {}
    for p in found["points"]:
        lines.setdefault(p["rule"], []).append(p)
    for rule, points in lines.items():
        tint, marker = looks.get(rule, ("#333333", "o"))
        fitted = data.slope([(p["directions"], p["rmse"]) for p in points], 50)
        label = rule if fitted is None else f"{rule}: directions^{fitted:.2f}"
        fig.axes[0].plot([p["directions"] for p in points], [p["rmse"] for p in points], color=tint, linewidth=1.1, label=label)
        for p in points:
            fig.point(fig.axes[0], p["directions"], p["rmse"], [f"{rule}, {p['directions']} directions", f"RMSE {p['rmse']:.5f}"],
                      marker=marker, markersize=5, color=tint)
    routes = list(dict.fromkeys(t["route"] for p in found["points"] for t in p["times"]))
    tints = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f4f24"]
    axes = fig.axes[1]
    for i, route in enumerate(routes):
        line = [(t["ms"], p["rmse"], p["rule"], p["directions"], t) for p in found["points"] for t in p["times"] if t["route"] == route]
        axes.plot([x for x, *_ in line], [y for _, y, *_ in line], color=tints[i % len(tints)], linewidth=1.1, label=route)
        for x, y, rule, directions, t in line:
            axes.plot([t["low"], t["high"]], [y, y], color=tints[i % len(tints)], alpha=0.5, linewidth=0.8)
            fig.point(axes, x, y, [f"{route}, {rule} {directions}", f"{x:.1f} ms ({t['low']:.1f} to {t['high']:.1f}), RMSE {y:.5f}"],
                      marker="o", markersize=4, color=tints[i % len(tints)])
    fig.axes[0].set_xlabel("directions")
    axes.set_xlabel("ms of a whole bake")
    for a in fig.axes:
        a.set_ylabel(f"RMSE against {found['truth_directions']} directions")
        a.legend(frameon=False, fontsize=8)
        log_axes(a, "xy")
    return titled(fig, chart, (0, 0, 1, 0.95))


FIGURES = [time_figure, cost_figure, flicker_figure, convergence_figure, classes_figure, vertices_figure]
