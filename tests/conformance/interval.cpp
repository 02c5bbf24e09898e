#include "ao/interval.hpp"
#include "ao/conformance/functions.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstddef>
#include <limits>

using namespace ao;

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

// Neighbouring floats from x, `steps` of them.
float step(float x, int steps)
{
    for (int i = 0; i < std::abs(steps); ++i) {
        x = std::nextafter(x, steps > 0 ? infinite : -infinite);
    }
    return x;
}

} // namespace

TEST_CASE("sums, differences and products of points are points, rounded to nearest")
{
    random_stream random(3);
    for (int i = 0; i < 100000; ++i) {
        const float a = conformance::detail::scattered(random, 40);
        const float b = conformance::detail::scattered(random, 40);
        const interval sum = interval(a) + interval(b);
        const interval difference = interval(a) - interval(b);
        const interval product = interval(a) * interval(b);
        REQUIRE((sum.is_point() && sum.lo == a + b));
        REQUIRE((difference.is_point() && difference.lo == a - b));
        REQUIRE((product.is_point() && product.lo == a * b));
    }
}

TEST_CASE("a quotient's interval holds what is 2.5 units away and nothing 4 away")
{
    random_stream random(4);
    for (int i = 0; i < 100000; ++i) {
        const float a = conformance::detail::scattered(random, 30);
        const float b = conformance::detail::scattered(random, 30);
        const double exact = static_cast<double>(a) / static_cast<double>(b);
        const auto nearest = static_cast<float>(exact);
        const interval q = interval(a) / interval(b);
        int inside = 0;
        for (int k = -5; k <= 5; ++k) {
            const float candidate = step(nearest, k);
            const double unit = std::ldexp(1.0, std::ilogb(exact) - 23);
            const double units = std::abs(static_cast<double>(candidate) - exact) / unit;
            REQUIRE(q.contains(candidate) == (units <= 2.5));
            inside += q.contains(candidate) ? 1 : 0;
        }
        REQUIRE(inside >= 5);
    }
}

TEST_CASE("a root's interval is that of 1 / inversesqrt, brute force")
{
    random_stream random(5);
    for (int i = 0; i < 20000; ++i) {
        const float x = std::abs(conformance::detail::scattered(random, 60));
        const interval bounds = real_traits<interval>::sqrt(interval(x));
        const double inverse = 1 / std::sqrt(static_cast<double>(x));
        REQUIRE(bounds.contains(std::sqrt(x)));
        // Every float within 2 units of the inverse, divided with an error of up to 2.5.
        for (int k = -3; k <= 3; ++k) {
            const float r = step(static_cast<float>(inverse), k);
            if (std::abs(static_cast<double>(r) - inverse) > 2 * std::ldexp(1.0, std::ilogb(inverse) - 23)) {
                continue;
            }
            const double root = 1 / static_cast<double>(r);
            for (int n = -3; n <= 3; ++n) {
                const float candidate = step(static_cast<float>(root), n);
                if (std::abs(static_cast<double>(candidate) - root) <= 2.5 * std::ldexp(1.0, std::ilogb(root) - 23)) {
                    REQUIRE(bounds.contains(candidate));
                }
            }
        }
        // And no wider than 7 units either way.
        REQUIRE_FALSE(bounds.contains(step(std::sqrt(x), 8)));
        REQUIRE_FALSE(bounds.contains(step(std::sqrt(x), -8)));
    }
}

TEST_CASE("operations on intervals hold the operations on their members")
{
    random_stream random(6);
    const auto draw = [&] {
        const float a = conformance::detail::scattered(random, 6);
        const float b = random.next() % 3 == 0 ? -a * random.uniform() : a * (1 + random.uniform());
        return a < b ? interval(a, b) : interval(b, a);
    };
    const auto member = [&](interval x) { return std::min(std::max(x.lo + (x.hi - x.lo) * random.uniform(), x.lo), x.hi); };
    using traits = real_traits<interval>;
    for (int i = 0; i < 200000; ++i) {
        const interval x = draw();
        const interval y = draw();
        const float a = member(x);
        const float b = member(y);
        REQUIRE((x + y).contains(a + b));
        REQUIRE((x - y).contains(a - b));
        REQUIRE((x * y).contains(a * b));
        REQUIRE((x / y).contains(a / b));
        REQUIRE((-x).contains(-a));
        REQUIRE(traits::abs(x).contains(std::abs(a)));
        REQUIRE(traits::floor(x).contains(std::floor(a)));
        REQUIRE(traits::min(x, y).contains(std::min(a, b)));
        REQUIRE(traits::max(x, y).contains(std::max(a, b)));
        const verdict less = x < y;
        REQUIRE((a < b ? less.may_hold : less.may_fail));
        const verdict at_most = x <= y;
        REQUIRE((a <= b ? at_most.may_hold : at_most.may_fail));
        const verdict equal = x == y;
        REQUIRE((a == b ? equal.may_hold : equal.may_fail));
        const auto whole = integer_interval<std::int32_t>(x);
        REQUIRE((whole.lo <= static_cast<int>(a) && static_cast<int>(a) <= whole.hi));
        const auto masked = whole & integer_interval<std::int32_t>(63);
        const int low = static_cast<int>(a) & 63;
        REQUIRE((masked.lo <= low && low <= masked.hi));
    }
}

TEST_CASE("verdicts follow three-valued logic")
{
    const verdict yes(true);
    const verdict no(false);
    const verdict either = verdict::either();
    CHECK((either && no).certain());
    CHECK_FALSE((either && no).may_hold);
    CHECK_FALSE((either && yes).certain());
    CHECK((either || yes).certain());
    CHECK_FALSE((either || yes).may_fail);
    CHECK_FALSE((!either).certain());
    const interval chosen = real_traits<interval>::select(interval(1), interval(3), either);
    CHECK((chosen.lo == 1 && chosen.hi == 3));
    CHECK(real_traits<interval>::select(interval(1), interval(3), yes).lo == 3);
    CHECK(real_traits<interval>::select(interval(1), interval(3), no).hi == 1);
}

TEST_CASE("what may be NaN is unknown, and comparisons of it say anything")
{
    CHECK(interval(nan_value).is_unknown());
    CHECK((interval(infinite) - interval(infinite)).is_unknown());
    CHECK((interval(0) * interval(infinite)).is_unknown());
    CHECK((interval(0) / interval(0)).is_unknown());
    CHECK((interval(1) / interval(-1.0F, 1.0F)).is_unknown());
    CHECK(real_traits<interval>::sqrt(interval(-1)).is_unknown());
    CHECK(real_traits<interval>::max(interval::unknown(), interval(0)).is_unknown());
    CHECK(interval::unknown().contains(nan_value));
    CHECK_FALSE(interval(0.0F, 1.0F).contains(nan_value));
    for (const verdict v : { interval::unknown() < interval(0), interval::unknown() <= interval(infinite),
                             interval::unknown() == interval::unknown(), interval(0) >= interval::unknown() }) {
        CHECK_FALSE(v.certain());
    }
}

TEST_CASE("denormals may have become 0")
{
    const interval tiny(1e-40F);
    CHECK((tiny.contains(0) && tiny.contains(1e-40F)));
    CHECK_FALSE((tiny > interval(0)).certain());
    const interval product = interval(1e-30F) * interval(1e-10F);
    CHECK((product.contains(0) && product.contains(1e-30F * 1e-10F)));
    CHECK((interval(-1e-30F) * interval(1e-10F)).contains(0));
    CHECK((interval(0) / interval(3)).is_point());
    // A reciprocal of what exceeds 2^126 is a denormal.
    CHECK((interval(1e38F) / interval(2e38F)).contains(0));
}

TEST_CASE("intervals work in constant expressions")
{
    constexpr interval third = interval(1) / interval(3);
    STATIC_REQUIRE(third.contains(1.0F / 3.0F));
    STATIC_REQUIRE_FALSE(third.is_point());
    constexpr interval unit = math<interval>::ao_normalize_or({ 3.0F, 0.0F, 4.0F }, { 0.0F, 0.0F, 1.0F }).x;
    STATIC_REQUIRE(unit.contains(0.6F));
    STATIC_REQUIRE(unit.hi - unit.lo < 1e-6F);
    STATIC_REQUIRE(math<interval>::ao_radical_inverse(5, 123456789U).is_point());
    STATIC_REQUIRE(math<interval>::ao_radical_inverse(5, 123456789U).lo == math<float>::ao_radical_inverse(5, 123456789U));
}

TEST_CASE("the bounds of every shared function hold scalar C++'s results, are points where it is exact, and say something")
{
    using bounds = conformance::evaluator<interval>;
    using scalar = conformance::evaluator<float>;
    for (const conformance::function_info& f : conformance::functions) {
        const conformance::function_inputs in = conformance::make_inputs(f, 3000);
        std::size_t unknown = 0;
        std::size_t outside = 0;
        std::size_t wide = 0;
        for (std::size_t i = 0; i < in.a.size(); ++i) {
            const glm::vec4& a = in.a[i];
            const glm::vec4& b = in.b[i];
            const auto allowed = bounds::ao_evaluate(f.function, { a.x, a.y, a.z, a.w }, { b.x, b.y, b.z, b.w });
            const auto made = scalar::ao_evaluate(f.function, { a.x, a.y, a.z, a.w }, { b.x, b.y, b.z, b.w });
            for (int k = 0; k < 4; ++k) {
                unknown += allowed[k].is_unknown() ? 1 : 0;
                outside += allowed[k].contains(made[k]) ? 0 : 1;
                wide += allowed[k].is_unknown() || allowed[k].is_point() ? 0 : 1;
            }
        }
        CAPTURE(f.name, in.a.size(), unknown);
        CHECK(outside == 0);
        CHECK((!f.exact || wide == 0));
        // Inputs that are not finite, and helpers that may count as parallel.
        CHECK(unknown < in.a.size() * 4 / 20);
    }
}
