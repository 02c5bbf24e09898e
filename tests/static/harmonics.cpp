// Spherical harmonics worked out by the compiler against their closed forms.
#include "ao/harmonics.hpp"
#include "static/support.hpp"

namespace {

using namespace static_test;

constexpr double pi = 3.14159265358979323846;

// W. Freeden and M. Schreiner, or any table of real harmonics: without the Condon-Shortley sign.
constexpr bool low_orders_agree(double x, double y, double z)
{
    const auto root = [](double squared) { return ao::detail::sqrt(squared); };
    const double first = root(3 / (4 * pi));
    const double second = root(15 / (4 * pi));
    const double third = root(35 / (32 * pi));
    const double closed[16] = { root(1 / (4 * pi)),
                                first * y,
                                first * z,
                                first * x,
                                second * x * y,
                                second * y * z,
                                root(5 / (16 * pi)) * (3 * z * z - 1),
                                second * x * z,
                                second / 2 * (x * x - y * y),
                                third * y * (3 * x * x - y * y),
                                root(105 / (4 * pi)) * x * y * z,
                                root(21 / (32 * pi)) * y * (5 * z * z - 1),
                                root(7 / (16 * pi)) * z * (5 * z * z - 3),
                                root(21 / (32 * pi)) * x * (5 * z * z - 1),
                                root(105 / (16 * pi)) * z * (x * x - y * y),
                                third * x * (x * x - 3 * y * y) };
    const auto values = ao::harmonics({ x, y, z }, 3);
    for (std::size_t i = 0; i < ao::max_harmonics; ++i) {
        if (!near(values[i], i < 16 ? closed[i] : 0, 2e-15)) {
            return false;
        }
    }
    return true;
}
static_assert(low_orders_agree(0, 0, 1) && low_orders_agree(0, 0, -1) && low_orders_agree(-1, 0, 0) && low_orders_agree(0, 1, 0));
static_assert(low_orders_agree(0.48, -0.6, 0.64) && low_orders_agree(-2.0 / 3, 1.0 / 3, -2.0 / 3));

// Unsoeld: the squares of a degree sum to (2 l + 1) / 4 pi.
constexpr bool degrees_keep_their_sum(double x, double y, double z)
{
    const auto values = ao::harmonics({ x, y, z });
    for (int l = 0; l <= ao::max_harmonic_order; ++l) {
        double sum = 0;
        for (int m = -l; m <= l; ++m) {
            sum += values[ao::harmonic_index(l, m)] * values[ao::harmonic_index(l, m)];
        }
        if (!near(sum * 4 * pi, 2.0 * l + 1, 1e-13)) {
            return false;
        }
    }
    return true;
}
static_assert(degrees_keep_their_sum(0, 0, 1) && degrees_keep_their_sum(0.48, -0.6, 0.64) && degrees_keep_their_sum(0, -1, 0));

static_assert(ao::harmonic_index(0, 0) == 0 && ao::harmonic_index(1, -1) == 1 && ao::harmonic_index(2, 2) == 8);
static_assert(ao::harmonic_count(0) == 1 && ao::harmonic_count(8) == ao::max_harmonics);

// pi, 2 pi / 3, pi / 4, 0, -pi / 24 over pi: Ramamoorthi and Hanrahan, SIGGRAPH 2001, eq. 8.
static_assert(near(ao::lobe_factor(1, 0), 1.0, 0.0) && near(ao::lobe_factor(1, 1), 2.0 / 3, 1e-16) &&
              near(ao::lobe_factor(1, 2), 0.25, 0.0) && near(ao::lobe_factor(1, 3), 0.0, 0.0) &&
              near(ao::lobe_factor(1, 4), -1.0 / 24, 1e-17));

} // namespace
