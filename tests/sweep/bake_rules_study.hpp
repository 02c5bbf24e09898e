// Errors of rules on the sphere against their directions, as bake_rules.cpp measures them, and how they are shown.
#pragma once

#include <string>
#include <vector>

struct rule_point {
    int directions = 0;    // on the whole sphere; a rule on the half sphere has half of them
    double error = 0;      // root mean square
    double worst = 0;      // greatest
    double estimated = 0;  // root mean square of finish_bake's estimates; 0 where nothing was baked
    double within_two = 0; // share of vertices whose error is at most twice their own estimate
};

struct rule_line {
    std::string rule;
    std::vector<rule_point> points;
};

struct rule_panel {
    std::string subject; // a mesh or a function
    std::string kind;    // of coefficient; empty for functions
    std::vector<rule_line> lines;
};

// Of the line through (log directions, log error), by least squares.
double slope_of(const rule_line& line);

// A header, then a line a point.
std::string rules_as_csv(const std::vector<rule_panel>& panels);

// Panels of equal size, three in a row, logarithmic along both axes, and a legend in the place after the last.
std::string rules_as_svg(const std::vector<rule_panel>& panels);
