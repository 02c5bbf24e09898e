#include "stability/table.hpp"

#include <cmath>
#include <cstdio>
#include <iterator>

namespace stability {

namespace {

bool has(subject& s, domain needed)
{
    switch (needed) {
    case domain::core:
        return true;
    case domain::passes:
        return s.passes() != nullptr;
    case domain::temporal:
        return s.temporal() != nullptr;
    case domain::scene:
        return s.scene() != nullptr;
    case domain::bake:
        break;
    }
    return s.baker() != nullptr;
}

std::string escaped(const char* text)
{
    std::string out;
    for (; *text != '\0'; ++text) {
        out += *text == '|' ? std::string("\\|") : std::string(1, *text);
    }
    return out;
}

std::string limit_of(const row& r)
{
    return (r.at_least ? "≥ " : "≤ ") + rounded(r.bound);
}

const char* verdict_of(const outcome& o)
{
    return o.of->missed ? (o.held ? "MET NOW" : "missed") : !o.held ? "FAILS" : !o.caught ? "does not bite" : "holds";
}

std::string quoted(const std::string& text)
{
    std::string out = "\"";
    for (const char c : text) {
        out += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
    }
    return out.append(1, '"');
}

} // namespace

std::string rounded(double figure)
{
    if (std::isinf(figure)) {
        return figure > 0 ? "endless" : "-endless";
    }
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", figure);
    return text;
}

outcome run(const row& r, std::vector<subject>& subjects)
{
    outcome o;
    o.of = &r;
    o.held = true;
    for (subject& s : subjects) {
        if (r.needs == domain::core && !o.figures.empty()) {
            break;
        }
        if (!has(s, r.needs)) {
            o.figures.emplace_back();
            continue;
        }
        const double figure = r.measure(s);
        o.figures.emplace_back(figure);
        o.held = o.held && holds(r, figure);
        if (!o.broken) {
            r.spoil(s);
            o.broken = r.measure(s);
            o.caught = !holds(r, *o.broken);
            s.heal();
        }
    }
    return o;
}

std::string markdown(const std::vector<outcome>& all, const std::vector<subject>& subjects)
{
    std::string text = "| row | what is measured | bound | from | core |";
    std::string line = "|---|---|---|---|---|";
    for (const subject& s : subjects) {
        text += std::string(" ") + s.name() + " |";
        line += "---|";
    }
    text += " with the fault | fault | verdict |\n" + line + "---|---|---|\n";
    for (const outcome& o : all) {
        const row& r = *o.of;
        text += "| " + escaped(r.id) + " | " + escaped(r.input) + " | " + limit_of(r) + " | " + escaped(r.source) + " |";
        const bool core = r.needs == domain::core;
        text += core && !o.figures.empty() && o.figures[0] ? " " + rounded(*o.figures[0]) + " |" : " |";
        for (std::size_t i = 0; i < subjects.size(); ++i) {
            text += !core && i < o.figures.size() && o.figures[i] ? " " + rounded(*o.figures[i]) + " |" : " |";
        }
        text += " " + (o.broken ? rounded(*o.broken) : std::string()) + " | " + escaped(r.fault) + " | " + verdict_of(o) + " |\n";
    }
    return text;
}

std::string json(const std::vector<outcome>& all, const std::vector<subject>& subjects)
{
    std::string text = "[\n";
    for (std::size_t k = 0; k < all.size(); ++k) {
        const outcome& o = all[k];
        const row& r = *o.of;
        text += "  {\"id\": " + quoted(r.id) + ", \"limit\": " + quoted(r.at_least ? "least" : "most") +
                ", \"bound\": " + rounded(r.bound) + ", \"figures\": {";
        bool first = true;
        for (std::size_t i = 0; i < o.figures.size(); ++i) {
            if (o.figures[i]) {
                text += (first ? "" : ", ") + quoted(r.needs == domain::core ? "core" : subjects[i].name()) + ": " +
                        (std::isinf(*o.figures[i]) ? quoted(rounded(*o.figures[i])) : rounded(*o.figures[i]));
                first = false;
            }
        }
        text += "}, \"fault\": " + (o.broken ? std::isinf(*o.broken) ? quoted(rounded(*o.broken)) : rounded(*o.broken) : "null") +
                ", \"verdict\": " + quoted(verdict_of(o)) + "}" + (k + 1 < all.size() ? "," : "") + "\n";
    }
    return text + "]\n";
}

} // namespace stability
