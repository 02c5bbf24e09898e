// The suite that any backend runs against itself: every shared function and every pass over awkward and random inputs,
// compared with the reference executor. A subject that says it is exact must give its bits; any other must stay inside the
// bounds of math<interval>, where only taps whose outcome the allowed errors leave open widen a pixel.
// Compile with -ffp-contract=off (ao::strict_fp).
#pragma once

#include "ao/conformance/cases.hpp"
#include "ao/conformance/functions.hpp"
#include "ao/conformance/reference.hpp"
#include "ao/picture.hpp"
#include "ao/plan.hpp"
#include "ao/result.hpp"

#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ao::conformance {

// name:     for the report
// exact:    true for software drivers, whose / and sqrt are correctly rounded: bits must be equal
// run:      the visibility of a frame; `normal` is empty where facts::normals is from_depth. errc::unsupported_format makes
//           a case skipped, any other error failed
// evaluate: out[i] = ao_evaluate(function, a[i], b[i]) as the backend's own compiler and device compute it
template <class S>
concept subject = requires(S& s, const settings& chosen, const facts& known, const camera& view, const picture& image,
                           int function, std::span<const glm::vec4> numbers, std::span<glm::vec4> out)
{
    {
        s.name()
        } -> std::convertible_to<std::string_view>;
    {
        s.exact()
        } -> std::same_as<bool>;
    {
        s.run(chosen, known, view, image, image)
        } -> std::same_as<result<picture>>;
    {
        s.evaluate(function, numbers, numbers, out)
        } -> std::same_as<result<success>>;
};

enum class outcome { passed, failed, skipped };

struct case_result {
    std::string name;
    outcome verdict = outcome::passed;
    std::string_view limit; // what this case allows
    double worst = 0;       // the greatest difference from the reference, absolute
    std::string detail;     // the first fault with its place, or what was measured
};

struct suite_options {
    std::size_t random_inputs = 4000; // per function, besides the awkward ones
    bool functions = true;
    bool passes = true;
};

struct suite_summary {
    int passed = 0;
    int failed = 0;
    int skipped = 0;
};

// One line, for a log.
inline std::string describe(const case_result& r)
{
    const char* word = r.verdict == outcome::passed ? "pass" : r.verdict == outcome::failed ? "FAIL" : "skip";
    char worst[32];
    std::snprintf(worst, sizeof worst, "%.3g", r.worst);
    return std::string(word) + "  " + r.name + "  [" + std::string(r.limit) + "; worst " + worst + "]" +
           (r.detail.empty() ? "" : "  " + r.detail);
}

namespace detail {

// The same bits; any NaN for NaN.
inline bool same_bits(float a, float b)
{
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) || (a != a && b != b);
}

// The sign of zero is nobody's promise: GLSL leaves that of min(0, -0) open, and Mesa folds float(int(x)) into trunc(x).
inline bool same_number(float a, float b)
{
    return a == b || same_bits(a, b);
}

inline std::string number(float x)
{
    char text[64];
    std::snprintf(text, sizeof text, "%.9g", static_cast<double>(x));
    return text;
}

inline std::string range(interval x)
{
    return std::string("[").append(number(x.lo)).append(", ").append(number(x.hi)).append("]");
}

// Collects the faults of one case: counts all, keeps the first.
class judge {
public:
    judge(std::string name, bool exact, bool (*same)(float, float)) : exact_(exact), same_(same)
    {
        result_.name = std::move(name);
        result_.limit = exact ? "no differing bit" : "inside the interval";
    }
    // One number at a place, named on demand.
    template <class Place>
    void check(float got, float reference, interval allowed, Place&& place)
    {
        ++numbers_;
        const double difference = std::abs(static_cast<double>(got) - static_cast<double>(reference));
        if (difference > result_.worst) {
            result_.worst = difference;
        }
        if (!allowed.contains(reference)) {
            fault(place() + ": the reference, " + number(reference) + ", leaves its own bounds " + range(allowed));
        }
        if (exact_ ? !same_(got, reference) : !allowed.contains(got)) {
            fault(place() + ": " + number(got) + " instead of " + (exact_ ? number(reference) : "a number in " + range(allowed)));
        }
    }
    void fault(std::string what)
    {
        if (faults_++ == 0) {
            result_.detail = std::move(what);
        }
    }
    void note(std::string what) { note_ = std::move(what); }
    case_result finish() &&
    {
        if (faults_ > 0) {
            result_.verdict = outcome::failed;
            result_.detail = std::to_string(faults_) + " of " + std::to_string(numbers_) + " wrong; " + result_.detail;
        }
        else {
            result_.detail = note_;
        }
        return std::move(result_);
    }

private:
    bool exact_;
    bool (*same_)(float, float);
    case_result result_;
    std::string note_;
    std::size_t numbers_ = 0;
    std::size_t faults_ = 0;
};

inline case_result without_answer(std::string name, const error& why)
{
    return { std::move(name), why.code() == errc::unsupported_format ? outcome::skipped : outcome::failed, "an answer", 0,
             std::string(why.reason()) };
}

} // namespace detail

template <subject S>
case_result run_function(S& s, const function_info& f, const suite_options& options)
{
    const function_inputs in = make_inputs(f, options.random_inputs);
    std::vector<glm::vec4> got(in.a.size(), glm::vec4(-12345.0F));
    const std::string name = "function " + std::string(f.name);
    if (const result<success> done = s.evaluate(f.function, in.a, in.b, got); !done) {
        return detail::without_answer(name, done.error());
    }
    detail::judge judge(name, s.exact(), detail::same_number);
    using bounds = evaluator<interval>;
    for (std::size_t i = 0; i < got.size(); ++i) {
        const glm::vec4 a = in.a[i];
        const glm::vec4 b = in.b[i];
        const glm::vec4 reference = evaluator<float>::ao_evaluate(f.function, a, b);
        const bounds::vec4 allowed =
            bounds::ao_evaluate(f.function, bounds::vec4(a.x, a.y, a.z, a.w), bounds::vec4(b.x, b.y, b.z, b.w));
        for (int k = 0; k < 4; ++k) {
            judge.check(got[i][k], reference[k], allowed[k], [&] {
                using detail::number;
                return "component " + std::to_string(k) + " of (" + number(a.x) + ", " + number(a.y) + ", " + number(a.z) + ", " +
                       number(a.w) + "), (" + number(b.x) + ", " + number(b.y) + ", " + number(b.z) + ", " + number(b.w) + ")";
            });
        }
    }
    return std::move(judge).finish();
}

// Bounds of a visibility as a stored texel says it: a code may be either neighbour of an unrepresentable value.
inline interval stored_bounds(interval visibility, pixel_format format)
{
    if (format != pixel_format::r8) {
        return visibility;
    }
    const auto code = [](float v, bool up) {
        const float scaled = (v < 0 ? 0.0F : v > 1 ? 1.0F : v) * 255.0F;
        return up ? std::ceil(scaled) : std::floor(scaled);
    };
    return { code(visibility.lo, false) / 255.0F, code(visibility.hi, true) / 255.0F };
}

template <subject S>
case_result run_pass_case(S& s, const pass_case& c)
{
    const result<plan> planned = make_plan(c.settings, c.facts, c.camera);
    if (!planned) {
        return detail::without_answer(c.name, planned.error());
    }
    const result<picture> got = s.run(c.settings, c.facts, c.camera, c.depth, c.normal);
    if (!got) {
        return detail::without_answer(c.name, got.error());
    }
    detail::judge judge(c.name, s.exact(), detail::same_bits);
    if (got->format != c.facts.output_format || got->width != c.facts.width || got->height != c.facts.height ||
        got->bytes.size() != got->pixels() * static_cast<std::size_t>(bytes_per_pixel(got->format))) {
        judge.fault("the picture has another size or format than asked for");
        return std::move(judge).finish();
    }
    const picture reference = reference_visibility(*planned, c.depth, c.normal);
    executor<interval> bounds(*planned, c.depth, c.normal);
    const values<interval>& allowed = bounds.run();
    std::size_t open = 0;
    for (std::size_t i = 0; i < got->pixels(); ++i) {
        const glm::vec4 texel = decode_texel<float>(*got, i);
        const float value = texel.x;
        const auto place = [&] {
            const auto width = static_cast<std::size_t>(c.facts.width);
            return "pixel (" + std::to_string(i % width) + ", " + std::to_string(i / width) + ")";
        };
        const interval limits = allowed.texels[i].x;
        open += limits.hi - limits.lo > 1e-5F ? 1U : 0U;
        const glm::vec4 expected = decode_texel<float>(reference, i);
        judge.check(value, expected.x, stored_bounds(limits, c.facts.output_format), place);
        if (c.settings.bent_normal) {
            for (int k = 1; k < 4; ++k) {
                judge.check(texel[k], expected[k], allowed.texels[i][k], [&] { return place() + ", bent normal"; });
            }
            const float square = texel.y * texel.y + texel.z * texel.z + texel.w * texel.w;
            // Rounded to multiples of 1/2048, each component by half of that.
            if (!(std::abs(square - 1) < 8.6e-4F)) {
                judge.fault(place() + ": a bent normal whose square is " + detail::number(square));
            }
        }
        if (!(value >= 0 && value <= 1)) {
            judge.fault(place() + ": visibility " + detail::number(value) + " is not in [0, 1]");
        }
    }
    judge.note(std::to_string(open) + " of " + std::to_string(got->pixels()) + " pixels left open by the allowed errors");
    return std::move(judge).finish();
}

// Calls reporter(const case_result&) after each case, functions first.
template <subject S, std::invocable<const case_result&> Reporter>
suite_summary run_suite(S& s, Reporter&& reporter, const suite_options& options = {})
{
    suite_summary summary;
    const auto report = [&](const case_result& r) {
        ++(r.verdict == outcome::passed ? summary.passed : r.verdict == outcome::failed ? summary.failed : summary.skipped);
        reporter(r);
    };
    if (options.functions) {
        for (const function_info& f : functions) {
            report(run_function(s, f, options));
        }
    }
    if (options.passes) {
        for (const choice& c : all_pairs()) {
            report(run_pass_case(s, make_case(c)));
        }
    }
    return summary;
}

} // namespace ao::conformance
