// The CPU's temporal passes.
#include "ao/cpu/temporal.hpp"
#include "unit/cpu_allocations.hpp"
#include "unit/cpu_threads.hpp"
#include "unit/temporal_cases.hpp"

#include <string>
#include <utility>

using namespace temporal_test;
using ao::cpu::view_of;
using ao::cpu::width;

namespace {

ao::host::temporal_runner_ptr make_runner(const ao::cpu::options& o)
{
    auto made = ao::host::make_cpu_temporal_runner(o);
    REQUIRE(made);
    return std::move(*made);
}

// A program, its pictures and a frame, without a runner.
struct small_program {
    temporal_case c;
    ao::temporal_plan plan;
    scene_frame frame;
    ao::picture visibility;

    explicit small_program(const temporal_case& of)
        : c(of),
          plan(*ao::make_temporal_plan(of.settings, of.facts)),
          frame(make_sequence(of)[3].frame),
          visibility(of.facts.frame.output_format, of.facts.frame.width, of.facts.frame.height)
    {
    }
    ao::temporal_images<ao::cpu::image_view> images()
    {
        return { view_of(frame.inputs.depth), view_of(frame.inputs.normal), view_of(frame.inputs.motion), view_of(visibility) };
    }
};

} // namespace

TEST_CASE("the CPU's temporal passes leave the reference's bits, with every number of lanes")
{
    for (const width w : { width::scalar, width::lanes4, width::lanes8, width::lanes16 }) {
        if (!ao::cpu::is_available(w)) {
            WARN("not run: this machine does not have " << ao::cpu::name_of(w));
            continue;
        }
        check_cases(*make_runner({ w, 1 }));
    }
}

TEST_CASE("the CPU's temporal passes leave the same bits with any threads and tiles")
{
    for (const ao::cpu::options& o : cpu_test::divisions()) {
        const auto runner = make_runner(o);
        INFO(o.threads << " threads, tiles of " << o.tile_width << "x" << o.tile_height);
        temporal_case odd = base_case("odd tiles");
        check_case(*runner, odd);
        odd.settings.format = ao::history_format::packed;
        odd.facts.frame.depth = ao::depth_source::hardware;
        odd.facts.frame.depth_format = ao::pixel_format::d24;
        odd.facts.frame.output_format = ao::pixel_format::r8;
        check_case(*runner, odd);
    }
}

TEST_CASE("the CPU runs nothing for a view that has come to rest, and goes on after requests that make no sense")
{
    const auto runner = make_runner({});
    check_rest(*runner);
    check_bad_requests(*runner);
}

TEST_CASE("the CPU's temporal passes take pictures with rows apart and at odd addresses")
{
    auto on = ao::cpu::temporal::create();
    REQUIRE(on);
    small_program small(base_case("rows apart"));
    auto program = on->prepare_temporal(small.plan);
    REQUIRE(program);
    auto images = small.images();
    std::vector<std::vector<std::byte>> kept;
    for (ao::cpu::image_view* v : { &images.depth, &images.normal, &images.motion, &images.visibility }) {
        const std::size_t apart = v->row_bytes + 8;
        kept.emplace_back(3 + apart * static_cast<std::size_t>(v->height));
        for (std::size_t y = 0; y < static_cast<std::size_t>(v->height); ++y) {
            std::memcpy(kept.back().data() + 3 + y * apart, static_cast<const std::byte*>(v->data) + y * v->row_bytes,
                        v->row_bytes);
        }
        v->data = kept.back().data() + 3;
        v->row_bytes = apart;
    }
    auto bound = on->bind_temporal(*program, small.plan, images);
    REQUIRE(bound);
    ao::temporal_state state;
    executor reference = make_executor(small.c.settings, small.c.facts);
    for (int i = 0; i < 3; ++i) {
        const auto frame = ao::next_frame(small.plan, state, small.frame.camera);
        REQUIRE(frame);
        for (std::size_t k = 0; k < frame->steps.size(); ++k) {
            on->record_temporal({}, *program, *bound, small.plan, *frame, k);
        }
        const picture& expected = reference.run(small.frame.inputs, small.frame.camera);
        std::size_t unlike = 0;
        for (int y = 0; y < expected.height; ++y) {
            for (int x = 0; x < expected.width; ++x) {
                unlike += std::memcmp(kept.back().data() + 3 + static_cast<std::size_t>(y) * images.visibility.row_bytes +
                                          static_cast<std::size_t>(4 * x),
                                      &expected.at(x, y).x, 4) == 0
                              ? 0
                              : 1;
            }
        }
        CHECK(unlike == 0);
    }
}

TEST_CASE("the CPU's temporal passes refuse pictures, plans and options that do not fit, and say which")
{
    CHECK(ao::cpu::temporal::create({ .threads = -1 }).error().code() == ao::errc::invalid_settings);
    CHECK(ao::cpu::temporal::create({ .lanes = static_cast<width>(77) }).error().code() == ao::errc::device);
    auto on = ao::cpu::temporal::create({ .threads = 1 });
    REQUIRE(on);
    CHECK(on->threads() == 1);
    small_program small(base_case("refused"));
    auto program = on->prepare_temporal(small.plan);
    REQUIRE(program);
    const auto good = small.images();
    REQUIRE(on->bind_temporal(*program, small.plan, good));
    const auto refused = [&](const ao::temporal_images<ao::cpu::image_view>& images, ao::errc code) {
        const auto bound = on->bind_temporal(*program, small.plan, images);
        REQUIRE_FALSE(bound);
        CHECK(bound.error().code() == code);
        return std::string(bound.error().reason());
    };
    using Catch::Matchers::StartsWith;
    auto bad = good;
    bad.depth.format = ao::pixel_format::d32f;
    CHECK_THAT(refused(bad, ao::errc::unsupported_format), StartsWith("depth"));
    bad = good;
    bad.normal.height -= 1;
    CHECK_THAT(refused(bad, ao::errc::invalid_size), StartsWith("normal"));
    bad = good;
    bad.motion.data = nullptr;
    CHECK_THAT(refused(bad, ao::errc::invalid_size), StartsWith("motion"));
    bad = good;
    bad.visibility.row_bytes -= 4;
    CHECK_THAT(refused(bad, ao::errc::invalid_size), StartsWith("visibility"));

    const auto mismatch = [&](const ao::temporal_settings& s, const ao::temporal_facts& f) {
        const auto other = ao::make_temporal_plan(s, f);
        REQUIRE(other);
        const auto bound = on->bind_temporal(*program, *other, good);
        REQUIRE_FALSE(bound);
        CHECK(bound.error().code() == ao::errc::plan_mismatch);
    };
    ao::temporal_settings s = small.c.settings;
    s.period = 12;
    mismatch(s, small.c.facts);
    s = small.c.settings;
    s.format = ao::history_format::packed;
    mismatch(s, small.c.facts);
    s = small.c.settings;
    s.filter = 1;
    mismatch(s, small.c.facts);
    ao::temporal_facts f = small.c.facts;
    f.frame.width += 1;
    mismatch(small.c.settings, f);
    f = small.c.facts;
    f.frame.depth = ao::depth_source::hardware;
    mismatch(small.c.settings, f);

    std::vector<std::uint32_t> words(ao::history_bytes(small.plan) / 4);
    CHECK(program->read_history(1, words));
    CHECK(program->write_history(0, words));
    words.pop_back();
    CHECK_FALSE(program->read_history(1, words));
    CHECK_FALSE(program->write_history(0, words));
}

#if defined(AO_COUNTS_ALLOCATIONS)
TEST_CASE("the CPU allocates nothing to run temporal passes")
{
    auto on = ao::cpu::temporal::create({ .threads = 1 });
    REQUIRE(on);
    temporal_case c = base_case("allocations");
    c.facts.frame.depth = ao::depth_source::hardware;
    c.facts.frame.depth_format = ao::pixel_format::d32f;
    small_program small(c);
    auto made = ao::temporal_effect<ao::cpu::temporal>::create(*on, c.settings, c.facts);
    REQUIRE(made);
    auto bound = made->bind(small.images());
    REQUIRE(bound);
    bool failed = false;
    const int before = cpu_test::allocations();
    for (int i = 0; i < 4; ++i) {
        failed = made->record({}, *bound, small.frame.camera).has_value() || failed;
    }
    const int after = cpu_test::allocations();
    CHECK_FALSE(failed);
    CHECK(after == before);
}
#endif
