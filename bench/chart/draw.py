#!/usr/bin/env python3
"""Draws a chart.json of `ao chart`: chart_NAME.svg, .png and one page chart.html that needs no network.

The same numbers give the same bytes. Needs Debian's python3-matplotlib.
"""
import argparse
import html
import io
import json
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import chart_data
import chart_figures

PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Ambient occlusion: error against time</title>
<style>
body { font: 14px/1.45 "DejaVu Sans", sans-serif; margin: 1.5em auto; max-width: 1180px; padding: 0 1em; color: #222; }
svg { width: 100%; height: auto; }
#tip { position: fixed; display: none; background: #fff; border: 1px solid #888; padding: .4em .6em; font-size: 12px;
       white-space: pre; pointer-events: none; box-shadow: 0 1px 5px #0004; }
[data-point] { cursor: pointer; }
table { border-collapse: collapse; font-size: 12px; }
td, th { padding: .15em .7em; text-align: right; border-bottom: 1px solid #ddd; }
td:first-child, th:first-child { text-align: left; }
</style></head><body>
<h1>Ambient occlusion: error against time</h1>
<p>Hover over a point to read it.</p>
@FIGURES@
@TABLE@
<div id="tip"></div>
<script>
const texts = @TEXTS@;
const tip = document.getElementById("tip");
function show(key, x, y) {
    tip.textContent = texts[key].join("\\n");
    tip.style.display = "block";
    tip.style.left = Math.min(x + 14, innerWidth - tip.offsetWidth - 8) + "px";
    tip.style.top = Math.min(y + 14, innerHeight - tip.offsetHeight - 8) + "px";
}
let found = 0;
for (const key in texts) {
    const mark = document.getElementById(key);
    if (!mark) continue;
    ++found;
    mark.setAttribute("data-point", "");
    mark.addEventListener("mousemove", event => show(key, event.clientX, event.clientY));
    mark.addEventListener("mouseleave", () => { tip.style.display = "none"; });
}
document.body.dataset.points = found;
if (texts[location.hash.slice(1)]) show(location.hash.slice(1), 40, 40);
</script></body></html>
"""


def svg_of(figure):
    buffer = io.StringIO()
    figure.figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": "ao chart"})
    return buffer.getvalue()


def table_of(chart):
    routes = [r["name"] for r in chart["routes"]]
    head = ["configuration", "RMSE", "worst", "bias", "systematic", "deviation", "sampling", "p99", "fetches", "operations", "bytes"]
    rows = [head + [f"{r}, ms/MP" for r in routes]]
    for c in chart["single"]:
        e, cost = c["error"], c["cost"] or {}
        times = {t["route"]: t["ms_per_megapixel"] for t in c["times"]}
        rows.append([c["name"]] + [f"{e[k]:.4f}" if k != "worst" else f"{e[k]['rmse']:.4f}"
                                   for k in ("rmse", "worst", "bias", "systematic", "deviation", "sampling", "p99")]
                    + [f"{cost[k]:g}" if k in cost else "" for k in ("fetches", "operations", "bytes")]
                    + [f"{times[r]:.1f}" if r in times else "" for r in routes])
    cells = ["".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in row) for tag, row in zip(["th"] + ["td"] * len(rows), rows)]
    return "<h2>Numbers</h2><table>" + "".join(f"<tr>{row}</tr>\n" for row in cells) + "</table>"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("json")
    parser.add_argument("--out", required=True, help="directory")
    parser.add_argument("--clock", choices=list(chart_figures.CLOCKS), default="wall")
    arguments = parser.parse_args()
    chart = chart_data.load(arguments.json)
    os.makedirs(arguments.out, exist_ok=True)
    figures, texts = [], {}
    for make in chart_figures.FIGURES:
        figure = make(chart, arguments.clock)
        if figure is None:
            continue
        svg = svg_of(figure)
        with open(os.path.join(arguments.out, f"chart_{figure.name}.svg"), "w", encoding="utf-8") as file:
            file.write(svg)
        figure.figure.savefig(os.path.join(arguments.out, f"chart_{figure.name}.png"), dpi=110, metadata={"Software": "ao chart"})
        figures.append(svg[svg.index("<svg"):])
        texts.update(figure.texts)
        print(os.path.join(arguments.out, f"chart_{figure.name}.svg"))
    safe = json.dumps(texts, sort_keys=True).replace("<", "\\u003c")
    page = PAGE.replace("@FIGURES@", "\n".join(figures)).replace("@TABLE@", table_of(chart)).replace("@TEXTS@", safe)
    with open(os.path.join(arguments.out, "chart.html"), "w", encoding="utf-8") as file:
        file.write(page)
    print(os.path.join(arguments.out, "chart.html"))


if __name__ == "__main__":
    main()
