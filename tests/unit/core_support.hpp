// Evaluating shared functions for any Real type on lists of plain inputs, so that one table serves every instantiation.
#pragma once

#include "ao/interval.hpp"
#include "ao/lanes.hpp"
#include "ao/math.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace core_test {

using lanes4 = ao::lanes<float, 4>;
using lanes8 = ao::lanes<float, 8>;
using lanes16 = ao::lanes<float, 16>;

template <class T>
inline constexpr int width_of = 1;
template <class T, int N, class Tag>
inline constexpr int width_of<ao::lanes<T, N, Tag>> = N;

// Value i of x.
inline float at(float x, int)
{
    return x;
}
inline double at(double x, int)
{
    return x;
}
inline std::int32_t at(std::int32_t x, int)
{
    return x;
}
inline std::uint32_t at(std::uint32_t x, int)
{
    return x;
}
template <class T, int N, class Tag>
T at(const ao::lanes<T, N, Tag>& x, int i)
{
    return x[i];
}

// Real (or integer) whose value i is f(i).
template <class T, class F>
T each(F f)
{
    if constexpr (width_of<T> == 1) {
        return static_cast<T>(f(0));
    }
    else {
        T x(0);
        for (int i = 0; i < width_of<T>; ++i) {
            x.v[i] = f(i);
        }
        return x;
    }
}

// f over all inputs, width_of<Real> at a time: f takes std::array<Real, In>, returns std::array<Real, Out>.
template <class Real, std::size_t In, class F>
auto evaluate(const std::vector<std::array<float, In>>& inputs, F f)
{
    constexpr auto width = static_cast<std::size_t>(width_of<Real>);
    using output = decltype(f(std::array<Real, In>{}));
    std::vector<std::array<double, std::tuple_size_v<output>>> results(inputs.size());
    for (std::size_t start = 0; start < inputs.size(); start += width) {
        std::array<Real, In> packed;
        for (std::size_t k = 0; k < In; ++k) {
            packed[k] = each<Real>([&](int i) {
                const std::size_t index = start + static_cast<std::size_t>(i);
                return inputs[index < inputs.size() ? index : start][k];
            });
        }
        const output made = f(packed);
        for (std::size_t i = 0; i < width && start + i < inputs.size(); ++i) {
            for (std::size_t k = 0; k < made.size(); ++k) {
                results[start + i][k] = static_cast<double>(at(made[k], static_cast<int>(i)));
            }
        }
    }
    return results;
}

template <class Vec>
auto parts(const Vec& v)
{
    return std::array{ v.x, v.y, v.z };
}

// Uniform directions, rounded to float.
class directions {
public:
    explicit directions(std::uint32_t seed) : engine_(seed) {}
    std::array<float, 3> next()
    {
        std::normal_distribution<double> normal;
        const double x = normal(engine_);
        const double y = normal(engine_);
        const double z = normal(engine_);
        const double norm = std::sqrt(x * x + y * y + z * z);
        return { static_cast<float>(x / norm), static_cast<float>(y / norm), static_cast<float>(z / norm) };
    }

private:
    std::mt19937 engine_;
};

} // namespace core_test
