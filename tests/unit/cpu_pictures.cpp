// The CPU backend's pictures equal the reference's bit for bit, whatever the width, the threads and the tiles.
#include "ao/conformance/cases.hpp"
#include "ao/conformance/reference.hpp"
#include "ao/cpu/backend.hpp"

#include <catch2/catch.hpp>
#include <oneapi/tbb/global_control.h>

#include <array>
#include <cstring>
#include <string>
#include <vector>

using namespace ao;

namespace {

struct named_backend {
    std::string name;
    cpu::backend backend;
};

std::vector<named_backend> make_backends()
{
    struct division {
        int threads;
        int tile_width;
        int tile_height;
    };
    constexpr std::array<division, 4> divisions{ { { 1, 0, 0 }, { 2, 64, 1 }, { 3, 7, 5 }, { 4, 1, 1 } } };
    std::vector<named_backend> made;
    for (const auto lanes : { cpu::width::scalar, cpu::width::lanes4, cpu::width::lanes8, cpu::width::lanes16 }) {
        for (const division& d : divisions) {
            if (cpu::is_available(lanes)) {
                made.push_back({ std::string(cpu::name_of(lanes)) + ", " + std::to_string(d.threads) + " threads, tiles of " +
                                     std::to_string(d.tile_width) + "x" + std::to_string(d.tile_height),
                                 std::move(*cpu::backend::create({ lanes, d.threads, d.tile_width, d.tile_height })) });
            }
        }
    }
    return made;
}

std::vector<named_backend>& backends()
{
    static oneapi::tbb::global_control more(oneapi::tbb::global_control::max_allowed_parallelism, 4);
    static std::vector<named_backend> all = make_backends();
    return all;
}

// Rows of `p` with `padding` bytes behind each, starting `offset` bytes behind an aligned address.
struct padded {
    std::vector<std::byte> bytes;
    cpu::image_view view;
    padded(const picture& p, std::size_t offset, std::size_t padding)
    {
        view = cpu::view_of(p);
        const std::size_t row = view.row_bytes;
        bytes.assign(offset + static_cast<std::size_t>(p.height) * (row + padding), std::byte{ 0xa5 });
        for (std::size_t y = 0; y < static_cast<std::size_t>(p.height); ++y) {
            std::memcpy(bytes.data() + offset + y * (row + padding), p.bytes.data() + y * row, row);
        }
        view.data = bytes.data() + offset;
        view.row_bytes = row + padding;
    }
};

picture render(cpu::backend& b, const conformance::pass_case& c, const plan& p)
{
    picture visibility(p.facts.output_format, p.facts.width, p.facts.height);
    auto program = b.prepare(p);
    REQUIRE(program);
    auto bound = b.bind(*program, p, { cpu::view_of(c.depth), cpu::view_of(c.normal), cpu::view_of(visibility) });
    REQUIRE(bound);
    for (std::size_t i = 0; i < p.passes.size(); ++i) {
        b.record_pass({}, *program, *bound, p, i);
    }
    return visibility;
}

void check_against_reference(const conformance::pass_case& c)
{
    const plan p = *make_plan(c.settings, c.facts, c.camera);
    const picture expected = conformance::reference_visibility(p, c.depth, c.normal);
    for (named_backend& each : backends()) {
        INFO(c.name << " on " << each.name);
        CHECK(render(each.backend, c, p).bytes == expected.bytes);
    }
}

} // namespace

TEST_CASE("All pairs of options give the reference's bits", "[cpu]")
{
    for (const conformance::choice& c : conformance::all_pairs()) {
        check_against_reference(conformance::make_case(c));
    }
}

TEST_CASE("Pictures of any size give the reference's bits from every format", "[cpu]")
{
    using size = std::pair<int, int>;
    const auto [width, height] =
        GENERATE(size{ 97, 61 }, size{ 1, 1 }, size{ 1, 50 }, size{ 50, 1 }, size{ 17, 3 }, size{ 16, 2 });
    const auto depth = GENERATE(from_range(conformance::depth_choices));
    const auto normals = GENERATE(from_range(conformance::normal_choices));
    conformance::pass_case c;
    c.settings.taps = 7;
    c.settings.radius = 2.0F;
    c.facts.width = width;
    c.facts.height = height;
    c.facts.depth = depth.source;
    c.facts.depth_format = depth.format;
    c.facts.normals = normals.source;
    c.facts.normal_format = normals.format;
    frustum f{ -1, 1, -0.75, 0.75, 0.25, 60 };
    c.camera.projection = make_projection(f);
    const conformance::surfaces seen = conformance::make_noise(width, height, 5);
    c.depth = pack_depth(seen.depth, width, height, depth.source, depth.format, c.camera.projection);
    if (normals.source != normal_source::from_depth) {
        c.normal = pack_normals(seen.normals, width, height, normals.source, normals.format);
    }
    conformance::poison(c.depth, 3);
    conformance::poison(c.normal, 4);
    for (const int filter : { 1, 5, 31 }) {
        c.settings.filter = filter;
        c.name = std::to_string(width) + "x" + std::to_string(height) + " " + std::string(depth.name) + " " +
                 std::string(normals.name) + " filter " + std::to_string(filter);
        check_against_reference(c);
    }
}

TEST_CASE("Rows may be padded and start anywhere; padding stays untouched", "[cpu]")
{
    const auto output = GENERATE(pixel_format::r32f, pixel_format::r8);
    conformance::choice choice{};
    choice[conformance::of_size] = 2; // 33x17
    conformance::pass_case c = conformance::make_case(choice);
    c.facts.output_format = output;
    const plan p = *make_plan(c.settings, c.facts, c.camera);
    const picture expected = conformance::reference_visibility(p, c.depth, c.normal);
    const padded depth(c.depth, 1, 12);
    const padded normal(c.normal, 6, 4);
    for (named_backend& each : backends()) {
        INFO(each.name);
        padded target(expected, 3, 8);
        std::memset(target.bytes.data(), 0x5a, target.bytes.size());
        auto program = each.backend.prepare(p);
        auto bound = each.backend.bind(*program, p, { depth.view, normal.view, target.view });
        REQUIRE(bound);
        for (std::size_t i = 0; i < p.passes.size(); ++i) {
            each.backend.record_pass({}, *program, *bound, p, i);
        }
        padded wanted(expected, 3, 8);
        const std::size_t row = cpu::view_of(expected).row_bytes;
        for (std::size_t i = 0; i < wanted.bytes.size(); ++i) {
            const bool is_pixel = i >= 3 && (i - 3) % (row + 8) < row;
            wanted.bytes[i] = is_pixel ? wanted.bytes[i] : std::byte{ 0x5a };
        }
        CHECK(target.bytes == wanted.bytes);
    }
}
