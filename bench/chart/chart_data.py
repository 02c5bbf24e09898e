"""Numbers of `ao chart --json` as what is drawn: points, fronts, slopes."""
import json
import math

# Wong 2011, told apart by most eyes; a method that is not listed takes the next of the spare ones.
COLORS = {
    "box": "#e69f00",
    "hemisphere": "#0072b2",
    "halton": "#009e73",
    "bitmask": "#d55e00",
    "ritschel": "#cc79a7",
    "fox-compton": "#56b4e9",
}
SPARE = ["#7f4f24", "#6a3d9a", "#b2df8a"]
MARKERS = {"cpu": "o", "gl compute": "s", "gl fragment": "D", "gl": "s", "vk": "^"}
CLOCKS = {"wall": "ms", "processor": "processor ms"}
FETCH = 10  # operations that a fetch costs on software drivers (docs/numerics.md)


def load(path):
    with open(path, encoding="utf-8") as file:
        chart = json.load(file)
    if chart.get("format") != "ao chart 1":
        raise SystemExit(f"{path}: not a file of `ao chart --json`")
    return chart


def color(method):
    return COLORS.get(method) or SPARE[sum(map(ord, method)) % len(SPARE)]


def mean(values):
    values = list(values)
    return sum(values) / len(values)


def percentile(values, share):
    values = sorted(values)
    return values[round(share * (len(values) - 1))]


def units(cost):
    return cost["operations"] + FETCH * cost["fetches"]


def best_constant(chart):
    return mean(v["best_constant_rmse"] for v in chart["views"]) if chart["views"] else None


def clock_names(clock):
    return {
        "wall": ("ms_per_megapixel", "low", "high"),
        "processor": ("processor_ms_per_megapixel", "processor_low", "processor_high"),
    }[clock]


def single_point(configuration, time, clock):
    """A configuration on one route; `time` None: its cost in units."""
    error = configuration["error"]
    point = {
        "name": configuration["name"],
        "method": configuration["method"],
        "varies": configuration["varies"],
        "y": error["rmse"],
        "y_low": error["rmse_low"],
        "y_high": error["rmse_high"],
        "error": error,
        "cost": configuration["cost"],
        "flicker": configuration["flicker"],
        "hollow": False,
        "clock": CLOCKS[clock],
    }
    if time is None:
        point["route"] = None
        point["x"] = point["x_low"] = point["x_high"] = units(configuration["cost"]) if configuration["cost"] else None
    else:
        middle, low, high = clock_names(clock)
        point["route"] = time["route"]
        point["x"], point["x_low"], point["x_high"] = time[middle], time[low], time[high]
    return point


def temporal_points(chart, route, clock):
    """Over time: filled where nothing moves, hollow in the pan. `route` None: cost in units."""
    points = []
    for configuration in chart["temporal"]:
        for motion, times, cost in (
            ("static", "still_times", configuration["cost"]["still"]),
            ("pan", "moving_times", configuration["cost"]["moving"]),
        ):
            seen = [m for m in configuration["motions"] if m["motion"] == motion]
            if not seen:
                continue
            rmse = [m["rmse"] for m in seen]
            point = {
                "name": configuration["name"] + (", nothing moves" if motion == "static" else ", pan"),
                "method": configuration["method"],
                "varies": motion,
                "y": mean(rmse),
                "y_low": percentile(rmse, 0.1),
                "y_high": percentile(rmse, 0.9),
                "error": {
                    "rmse": mean(rmse),
                    "bias": mean(m["bias"] for m in seen),
                    "p99": mean(m["p99"] for m in seen),
                    "worst": max(({"view": m["view"], "rmse": m["rmse"]} for m in seen), key=lambda w: w["rmse"]),
                },
                "cost": cost,
                "flicker": mean(m["flicker"] for m in seen),
                "hollow": motion == "pan",
                "clock": CLOCKS[clock],
            }
            if route is None:
                point["route"] = None
                point["x"] = point["x_low"] = point["x_high"] = units(cost) if cost else None
                points.append(point)
                continue
            middle, low, high = clock_names(clock)
            for time in configuration[times]:
                if time["route"].split()[0] == route.split()[0] and "fragment" not in route:
                    point = dict(point, route=route)
                    point["x"], point["x_low"], point["x_high"] = time[middle], time[low], time[high]
                    points.append(point)
    return points


def points_of(chart, route, clock):
    """All that was timed on a route, or all of it by cost in units where `route` is None."""
    points = []
    for configuration in chart["single"]:
        if not configuration["times"]:
            continue
        if route is None:
            points.append(single_point(configuration, None, clock))
        for time in configuration["times"]:
            if time["route"] == route:
                points.append(single_point(configuration, time, clock))
    points += temporal_points(chart, route, clock)
    return [p for p in points if p["x"] is not None and p["x"] > 0 and p["y"] is not None and p["y"] > 0]


def front(points, y="y"):
    """Those that no other is at least as good as in both, by growing cost."""
    best = math.inf
    kept = []
    for p in sorted(points, key=lambda q: (q["x"], q[y], q["name"])):
        if p[y] < best:
            best = p[y]
            kept.append(p)
    return kept


def slope(points, start):
    """Of log y over log x from `start` on, least squares; None where there are fewer than three."""
    logs = [(math.log(x), math.log(y)) for x, y in points if x >= start and y > 0]
    if len(logs) < 3:
        return None
    x0, y0 = mean(x for x, _ in logs), mean(y for _, y in logs)
    return sum((x - x0) * (y - y0) for x, y in logs) / sum((x - x0) ** 2 for x, _ in logs)


def convergence(chart, key):
    """By method: (taps, mean error) without a filter, at the usual storage."""
    lines = {}
    for c in chart["single"]:
        usual = c["depth"] == "linear" and c["normals"] == "rgba16f" and c["output"] == "r32f"
        if c["filter"] == 1 and usual and c["varies"] in ("convergence", "filter", "taps"):
            lines.setdefault(c["method"], {})[c["taps"]] = c["error"][key]
    return {method: sorted(line.items()) for method, line in lines.items() if len(line) >= 2}


def described(point, chart):
    """What hovering shows: lines of text."""
    error = point["error"]
    lines = [point["name"] + (f" on {point['route']}" if point["route"] else "")]
    if point["route"]:
        lines.append(f"{point['x']:.1f} {point['clock']} per megapixel ({point['x_low']:.1f} to {point['x_high']:.1f})")
    lines.append(f"RMSE {error['rmse']:.4f}, bias {error['bias']:+.4f}, p99 {error['p99']:.3f}")
    if "systematic" in error:
        lines.append(f"systematic {error['systematic']:.4f}, deviation {error['deviation']:.4f}, sampling {error['sampling']:.4f}")
    if "worst" in error:
        lines.append(f"worst {error['worst']['view']} {error['worst']['rmse']:.4f}")
    if point["cost"]:
        cost = point["cost"]
        lines.append(f"{cost['fetches']:g} fetches, {cost['operations']:g} operations, {cost['bytes']:g} bytes a pixel")
    if point["flicker"] is not None:
        lines.append(f"flicker {point['flicker']:.5f}")
    return lines
