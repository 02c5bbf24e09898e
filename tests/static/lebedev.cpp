// The table of Lebedev's rules: its shape, and small rules expanded by the compiler.
#include "ao/lebedev.hpp"
#include "ao/octahedral_order.hpp"
#include "ao/sphere_rule.hpp"

namespace {

constexpr bool near(double a, double b, double most)
{
    return a - b <= most && b - a <= most;
}

// Lebedev and Laikov 1999, table of the rules.
constexpr int published[32][2] = { { 3, 6 },      { 5, 14 },    { 7, 26 },     { 9, 38 },     { 11, 50 },    { 13, 74 },
                                   { 15, 86 },    { 17, 110 },  { 19, 146 },   { 21, 170 },   { 23, 194 },   { 25, 230 },
                                   { 27, 266 },   { 29, 302 },  { 31, 350 },   { 35, 434 },   { 41, 590 },   { 47, 770 },
                                   { 53, 974 },   { 59, 1202 }, { 65, 1454 },  { 71, 1730 },  { 77, 2030 },  { 83, 2354 },
                                   { 89, 2702 },  { 95, 3074 }, { 101, 3470 }, { 107, 3890 }, { 113, 4334 }, { 119, 4802 },
                                   { 125, 5294 }, { 131, 5810 } };

constexpr bool designs_are_the_published_ones()
{
    for (std::size_t i = 0; i < 32; ++i) {
        const ao::lebedev_design& design = ao::lebedev_designs[i];
        const bool negative = design.order == 13 || design.order == 25 || design.order == 27;
        if (design.order != published[i][0] || design.points != published[i][1] || design.negative != negative) {
            return false;
        }
    }
    return true;
}
static_assert(designs_are_the_published_ones());
static_assert(ao::lebedev_rows.size() == 1287);
static_assert(ao::find_lebedev(131) == ao::find_lebedev(5810) && ao::find_lebedev(131)->rows == 144);
static_assert(ao::find_lebedev(33) == nullptr && ao::find_lebedev(0) == nullptr);

constexpr bool rows_are_well_formed()
{
    for (const ao::lebedev_row& row : ao::lebedev_rows) {
        const double a = row.a;
        const double b = row.b;
        bool good = a == 0 && b == 0;
        if (row.orbit == ao::lebedev_orbit::pq0) {
            good = a > 0 && a < b && near(a * a + b * b, 1, 3e-16);
        }
        else if (row.orbit == ao::lebedev_orbit::llm) {
            good = a > 0 && b > 0 && a != b && near(2 * a * a + b * b, 1, 5e-16);
        }
        else if (row.orbit == ao::lebedev_orbit::rsw) {
            good = a > 0 && a < b && b * b < 1 - a * a - b * b;
        }
        if (!good) {
            return false;
        }
    }
    return true;
}
static_assert(rows_are_well_formed());

// Half an orbit has half its points, all different, none opposite to another; the second moment is isotropic.
constexpr bool expands(const ao::lebedev_row& row)
{
    std::array<ao::direction3, 24> points{};
    std::size_t count = 0;
    bool good = true;
    ao::for_half_orbit(row, [&](const ao::direction3& d, double weight) {
        good = good && weight == row.weight;
        for (std::size_t i = 0; i < count; ++i) {
            const ao::direction3& other = points[i];
            good = good && d != other && d != ao::direction3{ -other[0], -other[1], -other[2] };
        }
        points[count] = d;
        ++count;
    });
    double xx = 0;
    double yz = 0;
    for (std::size_t i = 0; i < count; ++i) {
        xx += points[i][0] * points[i][0];
        yz += points[i][1] * points[i][2];
    }
    return good && 2 * static_cast<int>(count) == ao::lebedev_points(row.orbit) &&
           near(xx * 3, static_cast<double>(count), 1e-14) && near(yz, 0, 1e-15);
}
static_assert(expands(ao::lebedev_rows[0]) && ao::lebedev_rows[0].orbit == ao::lebedev_orbit::a1);
static_assert(expands({ 0, ao::lebedev_orbit::a2, 0, 0, 1 }));
static_assert(expands({ 0, ao::lebedev_orbit::a3, 0, 0, 1 }));
static_assert(expands({ 0, ao::lebedev_orbit::pq0, 0.6, 0.8, 1 }));
static_assert(expands({ 0, ao::lebedev_orbit::llm, 0.6, 0.52915026221291811810, 1 }));
static_assert(expands({ 0, ao::lebedev_orbit::llm, 0.1, 0.98994949366116653416, 1 }));
static_assert(expands({ 0, ao::lebedev_orbit::rsw, 0.1, 0.3, 1 }));

// Consecutive quarters of the curve, which starts and ends at corners: the two ends of one side.
static_assert(ao::octahedral_place({ -1e-9, -1e-9, -1 }) == 0 && ao::octahedral_place({ 1e-9, -1e-9, -1 }) > 0xffff0000U);
static_assert(ao::rotated(ao::no_rotation, { 1, 2, 3 }) == ao::direction3{ 1, 2, 3 });
static_assert(ao::rotated(ao::rotation_of_quaternion(2, 0, 0, 2), { 1, 2, 3 }) == ao::direction3{ -2, 1, 3 });

} // namespace
