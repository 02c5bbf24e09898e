// Square root, sine and cosine that are constant expressions with every supported compiler.
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

namespace ao::detail {

// Correctly rounded: Newton's method in double, then the nearer of the neighbours by the sign of the residual.
constexpr double constexpr_sqrt(double x)
{
    if (!(x > 0) || x > std::numeric_limits<double>::max()) {
        return x == 0 || x > 0 ? x : std::numeric_limits<double>::quiet_NaN();
    }
    double scaled = x;
    double factor = 1;
    while (scaled >= 4) {
        scaled /= 4;
        factor *= 2;
    }
    while (scaled < 1) {
        scaled *= 4;
        factor /= 2;
    }
    double root = 1.5;
    for (int i = 0; i < 6; ++i) {
        root = (root + scaled / root) / 2;
    }
    // Split the root in halves of 26 bits: its square is then exact, and so is the sign of scaled - root^2.
    const double epsilon = std::numeric_limits<double>::epsilon();
    for (int i = 0; i < 2; ++i) {
        const double split = 134217729.0 * root;
        const double high = split - (split - root);
        const double low = root - high;
        const double residual = ((scaled - high * high) - 2 * high * low) - low * low;
        // root + epsilon/2 * ... is a midpoint: residual beyond root * epsilon means a neighbour is nearer.
        if (residual > root * epsilon) {
            root += epsilon;
        }
        else if (residual < -root * epsilon) {
            root -= epsilon;
        }
    }
    return root * factor;
}

constexpr float sqrt(float x)
{
    if (std::is_constant_evaluated()) {
        // double holds more than twice float's digits plus two, so rounding twice rounds correctly.
        return static_cast<float>(constexpr_sqrt(static_cast<double>(x)));
    }
    return std::sqrt(x);
}

constexpr double sqrt(double x)
{
    if (std::is_constant_evaluated()) {
        return constexpr_sqrt(x);
    }
    return std::sqrt(x);
}

constexpr float floor(float x)
{
    if (std::is_constant_evaluated()) {
        if (!(x > -8388608.0F && x < 8388608.0F)) {
            return x;
        }
        const float whole = static_cast<float>(static_cast<int>(x));
        return whole == x ? x : whole > x ? whole - 1.0F : whole; // -0 stays -0
    }
    return std::floor(x);
}

constexpr double floor(double x)
{
    if (std::is_constant_evaluated()) {
        if (!(x > -4503599627370496.0 && x < 4503599627370496.0)) {
            return x;
        }
        const auto whole = static_cast<double>(static_cast<long long>(x));
        return whole == x ? x : whole > x ? whole - 1.0 : whole;
    }
    return std::floor(x);
}

inline constexpr double pi = 3.14159265358979323846;

// Taylor series on an argument brought into [-pi, pi]; for tables, error below 1e-15 there.
constexpr double sine(double angle)
{
    const double turns = floor(angle / (2 * pi) + 0.5);
    const double x = angle - turns * 2 * pi;
    double term = x;
    double sum = x;
    for (int i = 1; i < 16; ++i) {
        term *= -x * x / ((2.0 * i) * (2.0 * i + 1.0));
        sum += term;
    }
    return sum;
}

constexpr double cosine(double angle)
{
    return sine(angle + pi / 2);
}

// Of x in [0, 1], for tables; error below 1e-15.
constexpr double cube_root(double x)
{
    if (!(x > 0)) {
        return 0;
    }
    double root = 1;
    for (int i = 0; i < 200; ++i) {
        const double next = (2 * root + x / (root * root)) / 3;
        if (!(next < root)) {
            break;
        }
        root = next;
    }
    return root;
}

} // namespace ao::detail
