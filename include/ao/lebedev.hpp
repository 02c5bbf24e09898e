// The 32 Lebedev-Laikov rules on the sphere, orders 3 to 131: sets of points invariant under the symmetries of the cube, whose
// weighted mean is the mean over the sphere of every spherical harmonic up to the order, to about 2e-14 in double (the
// summation's rounding, not the constants').
#pragma once

#include "ao/detail/elementary.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace ao {

// All permutations and signs of one point. a1, a2 and a3 have no parameter; both numbers of pq0 and llm are stored, and of rsw
// the two smallest, so that nothing cancels where the last one is computed.
enum class lebedev_orbit {
    a1,  // (0, 0, 1), 6 points
    a2,  // (0, 1, 1) / sqrt 2, 12
    a3,  // (1, 1, 1) / sqrt 3, 8
    pq0, // (0, a, b), a < b, 24
    llm, // (a, a, b), 24
    rsw, // (a, b, sqrt(1 - a^2 - b^2)), a < b < the third, 48
};

struct lebedev_row {
    int order;
    lebedev_orbit orbit;
    double a;
    double b;
    double weight; // of each point; all points of a rule sum to 1
};

namespace detail {

constexpr auto make_lebedev_rows()
{
    using enum lebedev_orbit;
    return std::to_array<lebedev_row>({
#include "ao/detail/lebedev_orbits.inc"
    });
}

} // namespace detail

// The rules one after another, by order.
inline constexpr auto lebedev_rows = detail::make_lebedev_rows();

constexpr int lebedev_points(lebedev_orbit orbit)
{
    constexpr std::array<int, 6> points{ 6, 12, 8, 24, 24, 48 };
    return points[static_cast<std::size_t>(orbit)];
}

// One rule: rows first ... first + rows - 1.
struct lebedev_design {
    int order = 0;
    int points = 0;
    std::size_t first = 0;
    std::size_t rows = 0;
    bool negative = false; // some weight is below 0: orders 13, 25 and 27
};

namespace detail {

constexpr std::array<lebedev_design, 32> make_lebedev_designs()
{
    std::array<lebedev_design, 32> designs{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < lebedev_rows.size(); ++i) {
        const lebedev_row& row = lebedev_rows[i];
        if (i == 0 || row.order != lebedev_rows[i - 1].order) {
            designs[count].order = row.order;
            designs[count].first = i;
            ++count;
        }
        lebedev_design& design = designs[count - 1];
        design.points += lebedev_points(row.orbit);
        ++design.rows;
        design.negative = design.negative || row.weight < 0;
    }
    return designs;
}

constexpr std::array<double, 3> lebedev_representative(const lebedev_row& row)
{
    switch (row.orbit) {
    case lebedev_orbit::a1:
        return { 0, 0, 1 };
    case lebedev_orbit::a2:
        return { 0, 0.70710678118654752440, 0.70710678118654752440 };
    case lebedev_orbit::a3:
        return { 0.57735026918962576451, 0.57735026918962576451, 0.57735026918962576451 };
    case lebedev_orbit::pq0:
        return { 0, row.a, row.b };
    case lebedev_orbit::llm:
        return { row.a, row.a, row.b };
    default:
        return { row.a, row.b, detail::sqrt(1 - row.a * row.a - row.b * row.b) };
    }
}

} // namespace detail

// By rising order.
inline constexpr std::array<lebedev_design, 32> lebedev_designs = detail::make_lebedev_designs();

// visit(std::array<double, 3> direction, double weight) for one of each pair of antipodal points of an orbit: that whose first
// component other than 0 is positive.
template <class Visit>
constexpr void for_half_orbit(const lebedev_row& row, const Visit& visit)
{
    std::array<double, 3> point = detail::lebedev_representative(row);
    std::sort(point.begin(), point.end());
    do {
        const std::size_t leading = point[0] > 0 ? 0 : point[1] > 0 ? 1 : 2;
        for (unsigned signs = 0; signs < 8; ++signs) {
            std::array<double, 3> signed_point = point;
            bool wanted = true;
            for (std::size_t i = 0; i < 3; ++i) {
                if ((signs >> i & 1U) != 0) {
                    wanted = wanted && i != leading && point[i] > 0;
                    signed_point[i] = -point[i];
                }
            }
            if (wanted) {
                visit(signed_point, row.weight);
            }
        }
    } while (std::next_permutation(point.begin(), point.end()));
}

// The design of this order (odd) or number of points (even; the two never coincide), or null.
constexpr const lebedev_design* find_lebedev(int order_or_points)
{
    for (const lebedev_design& design : lebedev_designs) {
        if (design.order == order_or_points || design.points == order_or_points) {
            return &design;
        }
    }
    return nullptr;
}

} // namespace ao
