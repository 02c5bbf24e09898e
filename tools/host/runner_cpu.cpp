#include "host/runner.hpp"

#include "ao/backend.hpp"
#include "ao/conformance/functions.hpp"
#include "ao/lanes.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <optional>
#include <utility>

namespace ao::host {

namespace {

using clock = std::chrono::steady_clock;

double ms_since(clock::time_point start)
{
    return std::chrono::duration<double, std::milli>(clock::now() - start).count();
}

// N inputs at a time; the last ones are padded with the first of the batch.
template <int N>
void evaluate_lanes(int function, std::span<const glm::vec4> a, std::span<const glm::vec4> b, std::span<glm::vec4> out)
{
    using functions = conformance::evaluator<lanes<float, N>>;
    using real = typename functions::real;
    for (std::size_t first = 0; first < a.size(); first += N) {
        const auto gather = [&](std::span<const glm::vec4> from, int component) {
            real x(0);
            for (int lane = 0; lane < N; ++lane) {
                const std::size_t i = first + static_cast<std::size_t>(lane);
                x.v[lane] = from[i < from.size() ? i : first][component];
            }
            return x;
        };
        const typename functions::vec4 x(gather(a, 0), gather(a, 1), gather(a, 2), gather(a, 3));
        const typename functions::vec4 y(gather(b, 0), gather(b, 1), gather(b, 2), gather(b, 3));
        const typename functions::vec4 result = functions::ao_evaluate(function, x, y);
        for (int lane = 0; lane < N && first + static_cast<std::size_t>(lane) < out.size(); ++lane) {
            glm::vec4& to = out[first + static_cast<std::size_t>(lane)];
            to = { result.x[lane], result.y[lane], result.z[lane], result.w[lane] };
        }
    }
}

class cpu_runner final : public runner {
public:
    explicit cpu_runner(cpu::backend b) : backend_(std::move(b)) {}

    std::string_view backend() const override { return "cpu"; }
    std::string device() const override
    {
        return std::to_string(backend_.threads()) + (backend_.threads() == 1 ? " thread" : " threads");
    }
    std::string route() const override { return std::string(cpu::name_of(backend_.lanes())); }
    bool exact() const override { return true; }

    ao::result<success> prepare(const settings& chosen, const facts& known, const camera& view) override
    {
        const auto start = clock::now();
        bound_.reset();
        auto made = effect<cpu::backend>::create(backend_, chosen, known, view);
        if (!made) {
            return made.error();
        }
        effect_.emplace(std::move(*made));
        depth_ = picture(known.depth_format, known.width, known.height);
        normal_ =
            known.normals == normal_source::from_depth ? picture() : picture(known.normal_format, known.width, known.height);
        visibility_ = picture(known.output_format, known.width, known.height);
        auto bound = effect_->bind({ cpu::view_of(depth_), cpu::view_of(normal_), cpu::view_of(visibility_) });
        if (!bound) {
            return bound.error();
        }
        bound_.emplace(std::move(*bound));
        first_frame_ms_ = ms_since(start);
        first_frame_ = true;
        return success{};
    }

    ao::result<success> set_camera(const camera& view) override
    {
        if (const auto wrong = effect_->set_camera(view)) {
            return *wrong;
        }
        return success{};
    }

    ao::result<success> upload(const picture& depth, const picture& normal) override
    {
        const facts& known = effect_->current_plan().facts;
        if (const auto fits = check_inputs(known, depth, normal); !fits) {
            return fits.error();
        }
        // Into the bytes that are bound.
        std::copy(depth.bytes.begin(), depth.bytes.end(), depth_.bytes.begin());
        if (known.normals != normal_source::from_depth) {
            std::copy(normal.bytes.begin(), normal.bytes.end(), normal_.bytes.begin());
        }
        return success{};
    }

    ao::result<std::vector<pass_time>> frame() override
    {
        std::vector<pass_time> times;
        const auto& passes = effect_->current_plan().passes;
        for (std::size_t i = 0; i < passes.size(); ++i) {
            const auto start = clock::now();
            effect_->record_pass({}, *bound_, i);
            times.push_back({ passes[i].type, ms_since(start) });
            first_frame_ms_ += first_frame_ ? times.back().ms : 0;
        }
        first_frame_ = false;
        return times;
    }

    ao::result<picture> download() override { return visibility_; }

    ao::result<success> evaluate(int function, std::span<const glm::vec4> a, std::span<const glm::vec4> b,
                                 std::span<glm::vec4> out) override
    {
        switch (backend_.lanes()) {
        case cpu::width::lanes4:
            evaluate_lanes<4>(function, a, b, out);
            break;
        case cpu::width::lanes8:
            evaluate_lanes<8>(function, a, b, out);
            break;
        case cpu::width::lanes16:
            evaluate_lanes<16>(function, a, b, out);
            break;
        default:
            for (std::size_t i = 0; i < a.size(); ++i) {
                out[i] = conformance::evaluator<float>::ao_evaluate(function, a[i], b[i]);
            }
        }
        return success{};
    }

private:
    cpu::backend backend_;
    picture depth_;
    picture normal_;
    picture visibility_;
    std::optional<effect<cpu::backend>> effect_;
    std::optional<effect<cpu::backend>::binding> bound_;
};

} // namespace

ao::result<runner_ptr> make_cpu_runner(const cpu::options& o)
{
    auto made = cpu::backend::create(o);
    if (!made) {
        return made.error();
    }
    return runner_ptr(std::make_unique<cpu_runner>(std::move(*made)));
}

} // namespace ao::host
