// What the CPU backend accepts, refuses and promises beside its pictures.
#include "ao/conformance/cases.hpp"
#include "ao/cpu/backend.hpp"
#include "unit/cpu_allocations.hpp"

#include <catch2/catch.hpp>
#include <oneapi/tbb/global_control.h>

#include <string>
#include <utility>

using namespace ao;

namespace {

conformance::pass_case make_small_case(int filter)
{
    conformance::choice choice{};
    choice[conformance::of_size] = 3; // 64x48
    choice[conformance::of_depth] = 1;
    conformance::pass_case c = conformance::make_case(choice);
    c.settings.filter = filter;
    return c;
}

} // namespace

TEST_CASE("A width is created exactly where it is available", "[cpu]")
{
    CHECK(cpu::is_available(cpu::width::automatic));
    CHECK(cpu::is_available(cpu::width::scalar));
    CHECK(cpu::is_available(cpu::width::lanes4));
    for (const auto w :
         { cpu::width::scalar, cpu::width::lanes4, cpu::width::lanes8, cpu::width::lanes16, static_cast<cpu::width>(77) }) {
        const auto made = cpu::backend::create({ w, 1 });
        INFO(cpu::name_of(w));
        CHECK(made.has_value() == cpu::is_available(w));
        if (made) {
            CHECK(made->lanes() == w);
        }
        else {
            CHECK(made.error().code() == errc::device);
            CHECK(made.error().reason().find(cpu::name_of(w)) != std::string_view::npos);
        }
    }
    const auto automatic = cpu::backend::create();
    REQUIRE(automatic);
    CHECK(automatic->lanes() != cpu::width::automatic);
    CHECK(automatic->lanes() != cpu::width::scalar);
    CHECK(automatic->threads() >= 1);
    CHECK(cpu::backend::create({ cpu::width::automatic, 1 })->threads() == 1);
    oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, 2);
    CHECK(cpu::backend::create({ cpu::width::automatic, 2 })->threads() == 2);
    CHECK(cpu::backend::create({ cpu::width::automatic, 3 })->threads() == 2);
    CHECK(cpu::backend::create()->threads() == 2);
}

TEST_CASE("Negative options are refused", "[cpu]")
{
    for (const cpu::options& o :
         { cpu::options{ cpu::width::automatic, -1, 0, 0 }, cpu::options{ cpu::width::automatic, 0, -1, 0 },
           cpu::options{ cpu::width::automatic, 0, 0, -1 } }) {
        const auto made = cpu::backend::create(o);
        REQUIRE_FALSE(made);
        CHECK(made.error().code() == errc::invalid_settings);
    }
}

TEST_CASE("Views that do not fit the plan are refused by name", "[cpu]")
{
    auto b = cpu::backend::create({ cpu::width::automatic, 1 });
    const conformance::pass_case c = make_small_case(1);
    const plan p = *make_plan(c.settings, c.facts, c.camera);
    auto program = b->prepare(p);
    picture visibility(p.facts.output_format, p.facts.width, p.facts.height);
    const host_images<cpu::image_view> good{ cpu::view_of(c.depth), cpu::view_of(c.normal), cpu::view_of(visibility) };
    REQUIRE(b->bind(*program, p, good));

    const auto refused = [&](const char* name, errc code, auto spoil) {
        host_images<cpu::image_view> bad = good;
        spoil(std::string(name) == "depth" ? bad.depth : std::string(name) == "normal" ? bad.normal : bad.visibility);
        const auto bound = b->bind(*program, p, bad);
        REQUIRE_FALSE(bound);
        CHECK(bound.error().code() == code);
        CHECK(bound.error().reason().substr(0, std::string(name).size()) == name);
    };
    for (const char* name : { "depth", "normal", "visibility" }) {
        refused(name, errc::invalid_size, [](cpu::image_view& v) { v.data = nullptr; });
        refused(name, errc::invalid_size, [](cpu::image_view& v) { ++v.width; });
        refused(name, errc::invalid_size, [](cpu::image_view& v) { --v.height; });
        refused(name, errc::invalid_size, [](cpu::image_view& v) { v.row_bytes -= 4; });
        refused(name, errc::invalid_size, [](cpu::image_view& v) { v.row_bytes += 2; });
        refused(name, errc::invalid_size, [](cpu::image_view& v) { v.row_bytes = std::size_t{ 1 } << 30U; });
        refused(name, errc::unsupported_format, [](cpu::image_view& v) { v.format = pixel_format::rg32f; });
    }
}

TEST_CASE("A normal that the plan does not read need not be there", "[cpu]")
{
    auto b = cpu::backend::create({ cpu::width::automatic, 1 });
    conformance::pass_case c = make_small_case(5);
    c.facts.normals = normal_source::from_depth;
    const plan p = *make_plan(c.settings, c.facts, c.camera);
    auto program = b->prepare(p);
    picture visibility(p.facts.output_format, p.facts.width, p.facts.height);
    CHECK(b->bind(*program, p, { cpu::view_of(c.depth), {}, cpu::view_of(visibility) }));
}

#if defined(AO_COUNTS_ALLOCATIONS)
TEST_CASE("Recording allocates nothing", "[cpu]")
{
    auto b = cpu::backend::create({ cpu::width::automatic, GENERATE(1, 2) });
    const conformance::pass_case c = make_small_case(5);
    auto effect = ao::effect<cpu::backend>::create(*b, c.settings, c.facts, c.camera);
    REQUIRE(effect);
    picture visibility(c.facts.output_format, c.facts.width, c.facts.height);
    auto bound = effect->bind({ cpu::view_of(c.depth), cpu::view_of(c.normal), cpu::view_of(visibility) });
    REQUIRE(bound);
    effect->record({}, *bound); // oneTBB's threads join with their first work
    const int before = cpu_test::allocations();
    for (int frame = 0; frame < 8; ++frame) {
        effect->record({}, *bound);
    }
    CHECK(cpu_test::allocations() == before);
}
#endif

TEST_CASE("Programs and bindings survive moves, and each binding writes its own picture", "[cpu]")
{
    auto b = cpu::backend::create({ cpu::width::automatic, 2 });
    const conformance::pass_case c = make_small_case(3);
    auto made = ao::effect<cpu::backend>::create(*b, c.settings, c.facts, c.camera);
    REQUIRE(made);
    picture first(c.facts.output_format, c.facts.width, c.facts.height);
    picture second = first;
    auto one = made->bind({ cpu::view_of(c.depth), cpu::view_of(c.normal), cpu::view_of(first) });
    auto other = made->bind({ cpu::view_of(c.depth), cpu::view_of(c.normal), cpu::view_of(second) });
    REQUIRE((one && other));
    auto moved = std::move(*made);
    auto moved_one = std::move(*one);
    moved.record({}, moved_one);
    CHECK(first.bytes != second.bytes);
    moved.record({}, *other);
    CHECK(first.bytes == second.bytes);
}
