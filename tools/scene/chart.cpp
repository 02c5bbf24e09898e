#include "chart.hpp"

#include "report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace ao::tools {
namespace {

constexpr double width = 640, height = 260, left = 62, right = 14, top = 12, bottom = 52;

// Wong 2011, told apart by most eyes and on light and dark ground.
constexpr std::array<const char*, 4> colors{ "#0072b2", "#e69f00", "#009e73", "#cc79a7" };

std::string text_of(double value)
{
    char text[64];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

std::string place(double value)
{
    char text[64];
    std::snprintf(text, sizeof text, "%.1f", value);
    return text;
}

// 1, 2 or 5 times a power of ten, so that about five of them make `range`.
double step_of(double range)
{
    const double rough = range / 5.0;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    const double share = rough / power;
    return power * (share <= 1.0 ? 1.0 : share <= 2.0 ? 2.0 : share <= 5.0 ? 5.0 : 10.0);
}

struct axes {
    double last_frame = 1.0;
    double most = 1.0;

    double x(double frame) const { return left + (width - left - right) * frame / last_frame; }
    double y(double value) const { return height - bottom - (height - top - bottom) * value / most; }
};

std::string label(double x, double y, const char* anchor, const std::string& text)
{
    return "<text x=\"" + place(x) + "\" y=\"" + place(y) + "\" text-anchor=\"" + anchor + "\">" + escape_html(text) +
           "</text>\n";
}

std::string straight(double x0, double y0, double x1, double y1, const char* style)
{
    return "<path d=\"M" + place(x0) + " " + place(y0) + "L" + place(x1) + " " + place(y1) + "\" " + style + "/>\n";
}

std::string grid(const axes& a, double step, std::size_t frames)
{
    std::string svg;
    for (int i = 0; i * step <= a.most * 1.0001; ++i) {
        svg += straight(left, a.y(i * step), width - right, a.y(i * step), "stroke=\"currentColor\" stroke-opacity=\".2\"");
        svg += label(left - 8, a.y(i * step) + 4, "end", text_of(i * step));
    }
    const double frame_step = std::max(1.0, std::ceil(step_of(static_cast<double>(frames))));
    for (double f = 0; f < static_cast<double>(frames); f += frame_step)
        svg += label(a.x(f), height - bottom + 17, "middle", text_of(f));
    return svg + label(width - right, height - bottom + 32, "end", "frame");
}

std::string path(const axes& a, const chart_line& line)
{
    std::string d;
    bool drawing = false;
    for (std::size_t f = 0; f < line.values.size(); ++f) {
        const bool there = line.values[f] && std::isfinite(*line.values[f]);
        if (there) {
            d += drawing ? 'L' : 'M';
            d += place(a.x(static_cast<double>(f))) + " " + place(a.y(*line.values[f]));
            // A point by itself is a dot.
            d += drawing ? "" : "h.1";
        }
        drawing = there;
    }
    return d;
}

} // namespace

std::string make_svg(const report_chart& chart)
{
    std::size_t frames = 0;
    double greatest = 0.0;
    for (const chart_line& line : chart.lines) {
        frames = std::max(frames, line.values.size());
        for (const auto& v : line.values)
            greatest = v && std::isfinite(*v) ? std::max(greatest, *v) : greatest;
    }
    axes a;
    a.last_frame = frames > 1 ? static_cast<double>(frames - 1) : 1.0;
    const double step = step_of(greatest > 0.0 ? greatest : 1.0);
    a.most = step * std::max(1.0, std::ceil(greatest / step - 1e-9));

    std::string svg = "<svg viewBox=\"0 0 640 260\" role=\"img\" aria-label=\"" + escape_html(chart.title) +
                      "\" font-size=\"12\" fill=\"currentColor\">\n" + grid(a, step, frames);
    for (const std::size_t f : chart.marks)
        svg += straight(a.x(static_cast<double>(f)), top, a.x(static_cast<double>(f)), height - bottom,
                        "stroke=\"currentColor\" stroke-dasharray=\"3 3\"");
    double legend = left;
    for (std::size_t i = 0; i < chart.lines.size(); ++i) {
        // The first is the widest, so that those that lie on it leave its sides to be seen.
        const double wide = std::max(1.5, 6.0 - 2.25 * static_cast<double>(i));
        const std::string style = "fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\" stroke=\"" +
                                  std::string(colors[i % colors.size()]) + "\" stroke-width=\"" + place(wide) + "\"";
        svg += "<path d=\"" + path(a, chart.lines[i]) + "\" " + style + "/>\n";
        svg += straight(legend, height - 10, legend + 22, height - 10, style.c_str());
        svg += label(legend + 30, height - 6, "start", chart.lines[i].name);
        legend += 52.0 + 6.6 * static_cast<double>(chart.lines[i].name.size());
    }
    return svg + "</svg>\n";
}

} // namespace ao::tools
