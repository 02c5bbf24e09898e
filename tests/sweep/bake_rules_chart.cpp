#include "sweep/bake_rules_study.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace {

constexpr double width = 330, height = 270, left = 52, right = 12, top = 30, bottom = 34;
constexpr int columns = 3;

struct look {
    const char* rule;
    const char* color; // Wong 2011, told apart by most eyes
    char mark;
};

// In the order in which they are drawn.
constexpr std::array<look, 6> looks{ {
    { "marsaglia", "#cc79a7", 'x' },
    { "halton", "#56b4e9", 'd' },
    { "halton cosine", "#d55e00", 'v' },
    { "fibonacci pairs", "#009e73", 's' },
    { "fibonacci", "#e69f00", '+' },
    { "lebedev", "#0072b2", 'o' },
} };

const look& look_of(std::string_view rule)
{
    return *std::find_if(looks.begin(), looks.end() - 1, [&](const look& l) { return l.rule == rule; });
}

template <class... Numbers>
std::string format(const char* pattern, Numbers... numbers)
{
    char text[256];
    std::snprintf(text, sizeof text, pattern, numbers...);
    return text;
}

std::string text_at(double x, double y, const char* anchor, const std::string& text, const char* more = "")
{
    return format("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\"%s>", x, y, anchor, more) + text + "</text>\n";
}

std::string stroke(double x0, double y0, double x1, double y1, const char* style)
{
    return format("<path d=\"M%.1f %.1fL%.1f %.1f\" %s/>\n", x0, y0, x1, y1, style);
}

std::string mark_at(double x, double y, const look& l)
{
    constexpr double r = 3.2;
    switch (l.mark) {
    case 'o':
        return format("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"2.6\" fill=\"%s\"/>\n", x, y, l.color);
    case 's':
        return format("<path d=\"M%.1f %.1fh6.4v6.4h-6.4z\" fill=\"none\" stroke=\"%s\"/>\n", x - r, y - r, l.color);
    case 'd':
        return format("<path d=\"M%.1f %.1fl4 4l-4 4l-4 -4z\" fill=\"none\" stroke=\"%s\"/>\n", x, y - 4, l.color);
    case 'v':
        return format("<path d=\"M%.1f %.1fh7.2l-3.6 6z\" fill=\"none\" stroke=\"%s\"/>\n", x - 3.6, y - 3, l.color);
    case 'x':
        return format("<path d=\"M%.1f %.1fl5.6 5.6m0 -5.6l-5.6 5.6\" fill=\"none\" stroke=\"%s\"/>\n", x - 2.8, y - 2.8,
                      l.color);
    default:
        return format("<path d=\"M%.1f %.1fh7.6m-3.8 -3.8v7.6\" fill=\"none\" stroke=\"%s\"/>\n", x - 3.8, y, l.color);
    }
}

// From the logarithms of what is shown to the picture.
struct axes {
    double x0 = 1e9, x1 = -1e9, y0 = 1e9, y1 = -1e9;
    double at_x = 0, at_y = 0;

    explicit axes(const rule_panel& panel)
    {
        for (const rule_line& line : panel.lines) {
            for (const rule_point& p : line.points) {
                x0 = std::min(x0, std::log10(p.directions) - 0.05);
                x1 = std::max(x1, std::log10(p.directions) + 0.05);
                y0 = std::min(y0, std::log10(p.error) - 0.22);
                y1 = std::max(y1, std::log10(p.error) + 0.25);
            }
        }
    }
    double x(double n) const { return at_x + left + (width - left - right) * (std::log10(n) - x0) / (x1 - x0); }
    double y(double e) const { return at_y + height - bottom - (height - top - bottom) * (std::log10(e) - y0) / (y1 - y0); }
    bool has_x(double n) const { return std::log10(n) >= x0 && std::log10(n) <= x1; }
    bool has_y(double e) const { return std::log10(e) >= y0 && std::log10(e) <= y1; }
};

std::string power_of_ten(int power)
{
    if (power >= -3) {
        return format("%g", std::pow(10.0, power));
    }
    return format("10<tspan dy=\"-4\" font-size=\"9\">\u2212%d</tspan>", -power);
}

std::string grid_of(const axes& a)
{
    std::string svg;
    const double x_end = a.at_x + width - right;
    const double y_end = a.at_y + height - bottom;
    const int every = a.y1 - a.y0 > 6 ? 4 : 1;
    for (int power = -20; power <= 1; ++power) {
        const double one = std::pow(10.0, power);
        for (const int digit : { 1, 2, 5 }) {
            const bool whole = digit == 1;
            if (a.has_y(one * digit) && (whole || every == 1)) {
                const double y = a.y(one * digit);
                svg += stroke(a.at_x + left, y, x_end, y,
                              whole ? "stroke=\"#000\" stroke-opacity=\".25\"" : "stroke=\"#000\" stroke-opacity=\".08\"");
                if (whole && power % every == 0) {
                    svg += text_at(a.at_x + left - 6, y + 4, "end", power_of_ten(power));
                }
            }
        }
    }
    for (const int n : { 10, 20, 50, 100, 200, 500, 1000, 2000, 5000 }) {
        if (a.has_x(n)) {
            svg += stroke(a.x(n), a.at_y + top, a.x(n), y_end, "stroke=\"#000\" stroke-opacity=\".08\"");
        }
        if (a.has_x(n) && (a.x1 - a.x0 < 2.5 || n == 10 || n == 100 || n == 1000)) {
            svg += text_at(a.x(n), y_end + 15, "middle", std::to_string(n));
        }
    }
    return svg;
}

// A line of this power of the directions that ends at this error, named above or below its middle.
std::string guide(const axes& a, const rule_line& beside, double error, double power, const char* name)
{
    const double n0 = beside.points.front().directions;
    const double n1 = beside.points.back().directions;
    const double middle = std::sqrt(n0 * n1);
    const bool above = error > beside.points.back().error;
    return stroke(a.x(n0), a.y(error * std::pow(n0 / n1, power)), a.x(n1), a.y(error),
                  "stroke=\"#555\" stroke-dasharray=\"5 4\"") +
           text_at(a.x(middle) + (above ? 4 : -4), a.y(error * std::pow(middle / n1, power)) + (above ? -4 : 10),
                   above ? "start" : "end", format("N<tspan dy=\"-4\" font-size=\"9\">%s</tspan>", name), " fill=\"#555\"");
}

std::string line_of(const axes& a, const rule_line& line)
{
    const look& l = look_of(line.rule);
    std::string path;
    std::string marks;
    for (const rule_point& p : line.points) {
        path += format("%c%.1f %.1f", path.empty() ? 'M' : 'L', a.x(p.directions), a.y(p.error));
        marks += mark_at(a.x(p.directions), a.y(p.error), l);
    }
    return "<path d=\"" + path + format("\" fill=\"none\" stroke=\"%s\" stroke-width=\"1.3\"/>\n", l.color) + marks;
}

std::string estimates_of(const axes& a, const rule_line& line)
{
    std::string path;
    for (const rule_point& p : line.points) {
        if (p.estimated > 0) {
            path += format("%c%.1f %.1f", path.empty() ? 'M' : 'L', a.x(p.directions), a.y(p.estimated));
        }
    }
    return path.empty()
               ? path
               : "<path d=\"" + path + "\" fill=\"none\" stroke=\"#0072b2\" stroke-dasharray=\"1.5 3\" stroke-width=\"1.6\"/>\n";
}

std::string panel_at(const rule_panel& panel, double x, double y)
{
    axes a(panel);
    a.at_x = x;
    a.at_y = y;
    std::string svg = text_at(x + left, y + top - 10, "start", panel.subject + (panel.kind.empty() ? "" : ", " + panel.kind),
                              " font-weight=\"bold\"") +
                      grid_of(a);
    const bool baked = !panel.kind.empty();
    if (baked) {
        const double step = a.y(1.0 / 255);
        svg += stroke(x + left, step, x + width - right, step, "stroke=\"#000\" stroke-opacity=\".5\"");
        svg += text_at(x + left + 4, step - 4, "start", "1/255");
    }
    for (const look& l : looks) {
        for (const rule_line& line : panel.lines) {
            if (line.rule == l.rule) {
                svg += line_of(a, line);
                svg += line.rule == "lebedev" ? estimates_of(a, line) : "";
                if (baked && line.rule == "marsaglia") {
                    svg += guide(a, line, 1.35 * line.points.back().error, -0.5, "\u22121/2");
                }
                if (baked && line.rule == "lebedev") {
                    svg += guide(a, line, 0.68 * line.points.back().error, -0.75, "\u22123/4");
                }
            }
        }
    }
    return svg;
}

std::string legend_at(double x, double y)
{
    std::string svg;
    double row = y + top + 10;
    for (auto l = looks.rbegin(); l != looks.rend(); ++l) {
        svg += stroke(x + left, row, x + left + 30, row, format("stroke=\"%s\" stroke-width=\"1.3\"", l->color).c_str());
        svg += mark_at(x + left + 15, row, *l) + text_at(x + left + 40, row + 4, "start", l->rule);
        row += 22;
    }
    svg += stroke(x + left, row, x + left + 30, row, "stroke=\"#0072b2\" stroke-dasharray=\"1.5 3\" stroke-width=\"1.6\"");
    svg += text_at(x + left + 40, row + 4, "start", "lebedev, as estimated by the bake");
    svg += text_at(x + left, row + 30, "start", "across: directions on the sphere");
    return svg + text_at(x + left, row + 48, "start", "up: root mean square error");
}

} // namespace

double slope_of(const rule_line& line)
{
    double x = 0;
    double y = 0;
    double xx = 0;
    double xy = 0;
    for (const rule_point& p : line.points) {
        const double u = std::log(p.directions);
        const double v = std::log(p.error);
        x += u;
        y += v;
        xx += u * u;
        xy += u * v;
    }
    const auto n = static_cast<double>(line.points.size());
    return (n * xy - x * y) / (n * xx - x * x);
}

std::string rules_as_csv(const std::vector<rule_panel>& panels)
{
    std::string csv = "subject,coefficient,rule,directions,rms,greatest,estimated,within_twice_estimate\n";
    for (const rule_panel& panel : panels) {
        for (const rule_line& line : panel.lines) {
            for (const rule_point& p : line.points) {
                csv += panel.subject + "," + panel.kind + "," + line.rule;
                csv += format(",%d,%.3e,%.3e", p.directions, p.error, p.worst);
                csv += panel.kind.empty() ? ",,\n" : format(",%.3e,%.3f\n", p.estimated, p.within_two);
            }
        }
    }
    return csv;
}

std::string rules_as_svg(const std::vector<rule_panel>& panels)
{
    const int rows = static_cast<int>(panels.size()) / columns + 1;
    std::string svg = format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %g %g\" font-family=\"sans-serif\" "
                             "font-size=\"11\" stroke-linejoin=\"round\">\n",
                             width * columns, height * rows) +
                      "<title>Errors of rules on the sphere against their directions</title>\n"
                      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
    int place = 0;
    const auto row = [&] { return place / columns; };
    for (const rule_panel& panel : panels) {
        svg += panel_at(panel, width * (place % columns), height * row());
        ++place;
    }
    return svg + legend_at(width * (place % columns), height * row()) + "</svg>\n";
}
