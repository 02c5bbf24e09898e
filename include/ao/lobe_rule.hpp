// Weighted designs for a glossy lobe (paper 3, DPRT): few directions by which the light that a Phong lobe gathers is averaged,
// exactly for light without high frequencies.
#pragma once

#include "ao/sphere_rule.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

namespace ao {

inline constexpr int max_lobe_order = 127;
inline constexpr double max_lobe_exponent = 8192;

namespace detail {

// Recurrence of the monic polynomials orthogonal on y = 0 ... 1 for the weight (1 - y)^a (Jacobi's, shifted): p_k+1 =
// (y - shift) p_k - square p_k-1. Written so that nothing cancels where a is large. k >= 0, square for k >= 1.
struct jacobi_step {
    double shift;
    double square;
};

inline jacobi_step jacobi_at(double a, int k)
{
    const double b = 2.0 * k + a;
    const double shift = k == 0 ? 1 / (a + 2) : (2.0 * k * (k + a + 1) + a) / (b * (b + 2));
    const double c = k * (k + a) / b;
    return { shift, k == 0 ? 0 : c * c / (b * b - 1) };
}

struct gauss_node {
    double y;
    double weight; // all sum to 1
};

// Gauss's rule of `count` nodes for that weight, exact for polynomials of degree 2 count - 1, by rising y. Nodes are the
// eigenvalues of the tridiagonal matrix of the recurrence (Golub and Welsch, Math. Comp. 23, 1969), found by bisection on its
// Sturm sequence, which cannot fail; weights are Christoffel's numbers. Precondition: a >= 0.
inline std::vector<gauss_node> gauss_jacobi(double a, int count)
{
    std::vector<jacobi_step> steps;
    steps.reserve(static_cast<std::size_t>(count));
    for (int k = 0; k < count; ++k) {
        steps.push_back(jacobi_at(a, k));
    }
    const auto nodes_below = [&](double y) {
        int below = 0;
        double ratio = 1;
        for (const jacobi_step& step : steps) {
            ratio = step.shift - y - step.square / ratio;
            // A zero counts as positive, and keeps the next quotient finite.
            ratio = ratio == 0 ? 1e-300 : ratio;
            below += ratio < 0 ? 1 : 0;
        }
        return below;
    };
    std::vector<gauss_node> nodes;
    double lower = 0;
    for (int i = 0; i < count; ++i) {
        double low = lower;
        double high = 1;
        while (true) {
            const double middle = low + (high - low) / 2;
            if (!(middle > low && middle < high)) {
                break;
            }
            (nodes_below(middle) > i ? high : low) = middle;
        }
        lower = low;
        // 1 / sum of the squares of the orthonormal polynomials p_k, which obey sqrt(square_k+1) p_k+1 = (y - shift_k) p_k -
        // sqrt(square_k) p_k-1.
        double before = 0;
        double here = 1;
        double squares = 0;
        for (int k = 0; k < count; ++k) {
            squares += here * here;
            if (k + 1 < count) {
                const jacobi_step& step = steps[static_cast<std::size_t>(k)];
                const double down = k == 0 ? 0 : std::sqrt(step.square);
                const double next =
                    ((low - step.shift) * here - down * before) / std::sqrt(steps[static_cast<std::size_t>(k) + 1].square);
                before = here;
                here = next;
            }
        }
        nodes.push_back({ low, 1 / squares });
    }
    return nodes;
}

} // namespace detail

// Directions about +z, and weights that sum to 1, whose weighted mean is that over the sphere of (2 a + 2) z+^a times any
// polynomial of degree <= order (harmonics up to it): rings of order + 1 directions at the heights of Gauss's rule, (order + 1)
// ceil((order + 1) / 2) in all. a = 1 is the diffuse lobe. Fails for an order outside 0 ... 127 or an exponent outside 0 ...
// 8192.
inline result<sphere_rule> lobe_rule(double a, int order)
{
    if (!(a >= 0 && a <= max_lobe_exponent)) {
        return error(errc::invalid_settings, "a lobe's exponent is outside 0 ... 8192");
    }
    if (order < 0 || order > max_lobe_order) {
        return error(errc::invalid_settings, detail::reason("a lobe's order is ", order, ", outside 0 ... ", max_lobe_order));
    }
    sphere_rule rule;
    rule.domain = rule_domain::lobe;
    rule.order = order;
    const int ring = order + 1;
    double turn = 0;
    for (const detail::gauss_node& node : detail::gauss_jacobi(a, order / 2 + 1)) {
        const double across = std::sqrt(node.y * (2 - node.y));
        for (int i = 0; i < ring; ++i) {
            const double angle = 2 * detail::pi * (i + turn) / ring;
            rule.directions.push_back({ across * detail::cosine(angle), across * detail::sine(angle), 1 - node.y });
            rule.weights.push_back(node.weight / ring);
        }
        // Rings turned against each other, by the golden ratio: directions are better spread where light is not smooth.
        turn += 0.61803398874989485;
        turn -= turn < 1 ? 0 : 1;
    }
    return rule;
}

} // namespace ao
