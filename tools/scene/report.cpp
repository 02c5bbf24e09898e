#include "report.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>

namespace ao::tools {
namespace {

using row = std::vector<std::string>;

std::string fixed(double value, int digits)
{
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    return text;
}

std::string shortest(double value)
{
    char text[64];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

row error_cells(const std::optional<report_error>& e)
{
    if (!e)
        return { "–", "–", "–" };
    char bias[64];
    std::snprintf(bias, sizeof bias, "%+.4f", e->bias);
    return { fixed(e->rmse, 4), bias, fixed(e->p99, 4) };
}

std::string passes_cell(const std::vector<report_pass>& passes, const char* between)
{
    std::string text;
    for (const report_pass& p : passes)
        text += (text.empty() ? "" : between) + p.name + " " + fixed(p.ms, 2);
    return text;
}

std::vector<row> run_table(const report_data& data, const char* between_passes)
{
    std::vector<row> rows{ { "backend", "device", "route", "passes, ms", "total ms", "first frame ms", "RMSE", "bias", "p99" } };
    for (const report_run& r : data.runs) {
        rows.push_back({ r.backend, r.device, r.route, passes_cell(r.passes, between_passes), fixed(r.total_ms, 2),
                         fixed(r.first_frame_ms, 1) });
        const row cells = error_cells(r.error);
        rows.back().insert(rows.back().end(), cells.begin(), cells.end());
    }
    if (data.best_constant) {
        rows.push_back({ "best constant", "", "", "", "", "" });
        const row cells = error_cells(data.best_constant);
        rows.back().insert(rows.back().end(), cells.begin(), cells.end());
    }
    return rows;
}

std::vector<row> scene_table(const report_data& data)
{
    std::vector<row> rows{ { "backend", "device", "route", "drawing ms", "drawn", "shading ms", "shading" } };
    const auto ms = [](const std::optional<double>& value) { return value ? fixed(*value, 2) : std::string("–"); };
    for (const report_scene& s : data.scenes)
        rows.push_back({ s.backend, s.device, s.route, ms(s.draw_ms), s.draws, ms(s.shade_ms), s.shading });
    return rows;
}

std::vector<row> agreement_table(const report_data& data)
{
    std::vector<row> rows{ { "of", "one", "other", "pixels", "differing", "largest difference" } };
    for (const report_agreement& a : data.agreements)
        rows.push_back(
            { a.what, a.a, a.b, std::to_string(a.pixels), std::to_string(a.differing), a.largest ? shortest(*a.largest) : "–" });
    return rows;
}

// Characters, not bytes, so that columns with UTF-8 in them line up.
std::size_t width_of(const std::string& text)
{
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u; }));
}

void append_text(std::string& out, const std::vector<row>& rows)
{
    std::vector<std::size_t> widths(rows.front().size());
    for (const row& r : rows)
        for (std::size_t c = 0; c < r.size(); ++c)
            widths[c] = std::max(widths[c], width_of(r[c]));
    for (const row& r : rows) {
        std::string line;
        for (std::size_t c = 0; c < r.size(); ++c)
            line += r[c] + std::string(widths[c] - width_of(r[c]) + 2, ' ');
        line.erase(line.find_last_not_of(' ') + 1);
        out += line + '\n';
    }
}

bool holds_numbers(const std::vector<row>& rows, std::size_t column)
{
    return std::all_of(rows.begin() + 1, rows.end(),
                       [&](const row& r) { return r[column].find_first_not_of("0123456789+-.e–") == std::string::npos; });
}

void append_html(std::string& out, const std::vector<row>& rows)
{
    out += "<div class=\"wide\"><table>\n";
    for (std::size_t r = 0; r < rows.size(); ++r) {
        out += "<tr>";
        const std::string cell = r == 0 ? "th" : "td";
        for (std::size_t c = 0; c < rows[r].size(); ++c)
            out +=
                "<" + cell + (holds_numbers(rows, c) ? " class=\"number\">" : ">") + escape_html(rows[r][c]) + "</" + cell + ">";
        out += "</tr>\n";
    }
    out += "</table></div>\n";
}

constexpr const char* style = R"(
:root { color-scheme: light dark; --text: #1b1b1b; --ground: #fcfcfc; --line: #cfcfcf; --soft: #f0f0f0; --mark: #b3541e }
@media (prefers-color-scheme: dark) { :root { --text: #e4e4e4; --ground: #161616; --line: #444; --soft: #242424; --mark: #f0a070 } }
body { font: 15px/1.5 system-ui, sans-serif; color: var(--text); background: var(--ground); margin: 0 auto; padding: 1.5rem; max-width: 1320px }
h1 { font-size: 1.5rem } h2 { font-size: 1.15rem; margin-top: 2rem }
table { border-collapse: collapse; font-variant-numeric: tabular-nums }
th, td { text-align: left; padding: .25rem .8rem .25rem 0; border-bottom: 1px solid var(--line); vertical-align: top }
.wide { overflow-x: auto } .wide th, .wide td { white-space: pre } .number { text-align: right }
.facts th { font-weight: 600; padding-right: 1.5rem; white-space: nowrap } .facts td { white-space: pre-line }
.chooser { display: flex; flex-wrap: wrap; justify-content: space-between; gap: 1rem; margin: .5rem 0 }
select { max-width: 100% }
select, input { font: inherit; color: inherit; background: var(--soft); border: 1px solid var(--line); border-radius: 4px; padding: .15rem .4rem }
.compare { position: relative; line-height: 0; border: 1px solid var(--line); touch-action: none; cursor: ew-resize; user-select: none }
.compare img { width: 100%; display: block; image-rendering: pixelated }
.compare .over { position: absolute; inset: 0; clip-path: inset(0 calc(100% - var(--split, 50%)) 0 0) }
.compare .bar { position: absolute; top: 0; bottom: 0; left: var(--split, 50%); width: 2px; margin-left: -1px; background: var(--mark) }
.charts { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 520px), 1fr)); gap: 1rem 2rem }
.charts svg { width: 100%; display: block }
.slide { width: 100%; margin: .5rem 0; padding: 0; accent-color: var(--mark) }
.all { display: grid; grid-template-columns: repeat(auto-fill, minmax(280px, 1fr)); gap: 1rem }
figure { margin: 0 } figure img { width: 100%; border: 1px solid var(--line) } figcaption { font-size: .9rem }
)";

constexpr const char* script = R"(
const pictures = [...document.querySelectorAll('figure img')];
const frame = document.querySelector('.compare');
const slide = document.querySelector('.slide');
const sides = [
  { choice: document.getElementById('left'), image: frame.querySelector('.over') },
  { choice: document.getElementById('right'), image: frame.querySelector('.under') } ];
for (const side of sides) {
  const show = () => { side.image.src = pictures[side.choice.value].src; side.image.alt = pictures[side.choice.value].alt; };
  side.choice.addEventListener('change', show);
  show();
}
const split = percent => { frame.style.setProperty('--split', percent + '%'); slide.value = percent; };
const follow = event => {
  const box = frame.getBoundingClientRect();
  split(Math.min(100, Math.max(0, 100 * (event.clientX - box.left) / box.width)));
};
frame.addEventListener('pointerdown', event => { frame.setPointerCapture(event.pointerId); follow(event); });
frame.addEventListener('pointermove', event => { if (event.buttons) follow(event); });
frame.addEventListener('dragstart', event => event.preventDefault());
slide.addEventListener('input', () => split(slide.value));
)";

std::string options(const std::vector<report_picture>& pictures, std::size_t chosen)
{
    std::string html;
    for (std::size_t i = 0; i < pictures.size(); ++i)
        html += "<option value=\"" + std::to_string(i) + "\"" + (i == chosen ? " selected" : "") + ">" +
                escape_html(pictures[i].name) + "</option>";
    return html;
}

void append_pictures(std::string& out, const std::vector<report_picture>& pictures)
{
    out += "<h2>Side by side</h2>\n<div class=\"chooser\"><label>left <select id=\"left\">" + options(pictures, 0) +
           "</select></label><label>right <select id=\"right\">" +
           options(pictures, std::min<std::size_t>(1, pictures.size() - 1)) +
           "</select></label></div>\n"
           "<div class=\"compare\"><img class=\"under\" alt=\"\"><img class=\"over\" alt=\"\"><div class=\"bar\"></div></div>\n"
           "<input class=\"slide\" type=\"range\" min=\"0\" max=\"100\" step=\"0.1\" value=\"50\" aria-label=\"split\">\n"
           "<h2>All pictures</h2>\n<div class=\"all\">\n";
    for (const report_picture& p : pictures)
        out += "<figure><img alt=\"" + escape_html(p.name) + "\" src=\"data:image/png;base64," + to_base64(p.png) +
               "\"><figcaption>" + escape_html(p.name) + "</figcaption></figure>\n";
    out += "</div>\n<script>" + std::string(script) + "</script>\n";
}

void append_charts(std::string& out, const std::vector<report_chart>& charts)
{
    out += "<h2>By frame</h2>\n<div class=\"charts\">\n";
    for (const report_chart& c : charts)
        out += "<figure><figcaption>" + escape_html(c.title) + "</figcaption>" + make_svg(c) + "</figure>\n";
    out += "</div>\n";
}

} // namespace

std::string escape_html(const std::string& text)
{
    std::string html;
    for (const char c : text)
        switch (c) {
        case '&':
            html += "&amp;";
            break;
        case '<':
            html += "&lt;";
            break;
        case '>':
            html += "&gt;";
            break;
        case '"':
            html += "&quot;";
            break;
        case '\'':
            html += "&#39;";
            break;
        default:
            html += c;
        }
    return html;
}

std::string to_base64(const std::string& bytes)
{
    constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    const auto byte = [&](std::size_t i) -> std::uint32_t {
        return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u;
    };
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::uint32_t group = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
        text += digits[group >> 18 & 63u];
        text += digits[group >> 12 & 63u];
        text += i + 1 < bytes.size() ? digits[group >> 6 & 63u] : '=';
        text += i + 2 < bytes.size() ? digits[group & 63u] : '=';
    }
    return text;
}

std::string make_report(const report_data& data)
{
    std::string out = "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\">"
                      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"><title>" +
                      escape_html(data.title) + "</title>\n<style>" + style + "</style></head>\n<body>\n<h1>" +
                      escape_html(data.title) + "</h1>\n<table class=\"facts\">\n";
    for (const auto& [name, value] : data.facts)
        out += "<tr><th>" + escape_html(name) + "</th><td>" + escape_html(value) + "</td></tr>\n";
    out += "</table>\n<h2>Runs</h2>\n";
    append_html(out, run_table(data, "\n"));
    if (!data.scenes.empty()) {
        out += "<h2>Drawing and shading</h2>\n";
        append_html(out, scene_table(data));
    }
    for (const report_table& t : data.tables) {
        out += "<h2>" + escape_html(t.title) + "</h2>\n";
        append_html(out, t.rows);
    }
    if (!data.charts.empty())
        append_charts(out, data.charts);
    if (!data.agreements.empty()) {
        out += "<h2>Agreement in bits</h2>\n";
        append_html(out, agreement_table(data));
    }
    if (!data.pictures.empty())
        append_pictures(out, data.pictures);
    out += "</body>\n</html>\n";
    return out;
}

std::string make_table(const report_data& data)
{
    std::string out;
    append_text(out, run_table(data, ", "));
    if (!data.scenes.empty()) {
        out += '\n';
        append_text(out, scene_table(data));
    }
    for (const report_table& t : data.tables) {
        out += '\n';
        append_text(out, t.rows);
    }
    if (!data.agreements.empty()) {
        out += '\n';
        append_text(out, agreement_table(data));
    }
    return out;
}

} // namespace ao::tools
