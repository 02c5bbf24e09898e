// The Vulkan passes against scalar C++, bit for bit, on adversarial G-buffers.
#include "ao/conformance/reference.hpp"
#include "support/vk_runner.hpp"

#include <catch2/catch.hpp>

#include <random>

namespace {

using ao::depth_source;
using ao::normal_source;
using ao::pixel_format;

constexpr int width = 97;
constexpr int height = 61;

struct g_buffer {
    std::vector<float> depth;
    std::vector<glm::vec3> normals;
};

// Rough ground with holes, single pixels, and values that no renderer means to write.
g_buffer random_g_buffer(int w, int h, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0.0F, 1.0F);
    g_buffer g;
    for (int i = 0; i < w * h; ++i) {
        const float kind = unit(random);
        g.depth.push_back(kind < 0.08F ? 0.0F : 2.0F + 0.02F * static_cast<float>(i / w) + 0.6F * unit(random) * unit(random));
        glm::vec3 n(2 * unit(random) - 1, 2 * unit(random) - 1, 2 * unit(random) - 1);
        const float norm = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
        g.normals.push_back(kind > 0.98F ? glm::vec3(0.0F) : kind > 0.96F ? glm::vec3(0, 0, -1) : n / norm);
    }
    return g;
}

struct depth_kind {
    depth_source source;
    pixel_format format;
};
struct normal_kind {
    normal_source source;
    pixel_format format;
};

constexpr depth_kind depth_kinds[] = {
    { depth_source::linear, pixel_format::r32f },      { depth_source::hardware, pixel_format::d32f },
    { depth_source::hardware, pixel_format::d24 },     { depth_source::hardware, pixel_format::r32f },
    { depth_source::position, pixel_format::rgba16f }, { depth_source::position, pixel_format::rgba32f },
};
constexpr normal_kind normal_kinds[] = {
    { normal_source::vector, pixel_format::rgba16f },     { normal_source::vector, pixel_format::rgba32f },
    { normal_source::unorm10, pixel_format::rgb10a2 },    { normal_source::octahedral, pixel_format::rg16 },
    { normal_source::from_depth, pixel_format::rgba16f },
};

ao::camera test_camera(bool parallel)
{
    ao::projection_options options;
    options.parallel = parallel;
    options.reversed = true;
    ao::camera view;
    view.projection = parallel ? ao::make_projection({ -2, 1.5, -1, 1.2, 0.5, 20 }, options)
                               : ao::make_projection({ -0.8, 0.7, -0.5, 0.45, 0.1, 50 }, options);
    // A rotation about (1, 2, 2) / 3 by 90 degrees.
    view.normal_to_view = glm::mat3(1.0F / 9, 8.0F / 9, -4.0F / 9, -4.0F / 9, 4.0F / 9, 7.0F / 9, 8.0F / 9, 1.0F / 9, 4.0F / 9);
    return view;
}

std::size_t differing(const ao::picture& a, const ao::picture& b)
{
    const std::size_t size = static_cast<std::size_t>(ao::bytes_per_pixel(a.format));
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.bytes.size(); i += size) {
        count +=
            !std::equal(a.bytes.begin() + static_cast<std::ptrdiff_t>(i), a.bytes.begin() + static_cast<std::ptrdiff_t>(i + size),
                        b.bytes.begin() + static_cast<std::ptrdiff_t>(i));
    }
    return count;
}

ao::host::vulkan_device& validated_device()
{
    static auto device = ao::host::vulkan_device::create({ "", true });
    REQUIRE(device);
    return **device;
}

struct job {
    ao::settings settings;
    ao::facts facts;
    ao::camera camera;
};

job make_job(const depth_kind& d, const normal_kind& n, int filter)
{
    job j;
    j.settings.taps = 16;
    j.settings.radius = 0.5F;
    j.settings.filter = filter;
    j.facts = { width, height, d.source, d.format, n.source, n.format, false, false, pixel_format::r32f };
    j.camera = test_camera(false);
    return j;
}

// Pixels that differ from the reference with the shaders for CPUs or with those for GPUs.
std::size_t difference(const job& j, const g_buffer& g, ao::vk::group_size group = {})
{
    const ao::facts& f = j.facts;
    const ao::picture depth = ao::pack_depth(g.depth, f.width, f.height, f.depth, f.depth_format, j.camera.projection);
    ao::picture normal;
    if (f.normals != normal_source::from_depth) {
        normal = ao::pack_normals(g.normals, f.width, f.height, f.normals, f.normal_format);
    }
    const auto plan = ao::make_plan(j.settings, f, j.camera);
    REQUIRE(plan);
    const ao::picture expected = ao::conformance::reference_visibility(*plan, depth, normal);
    std::size_t count = 0;
    for (const auto which : { vk_runner::shaders::of_device, vk_runner::shaders::of_gpu }) {
        const auto actual = vk_runner::run(validated_device(), j.settings, f, j.camera, depth, normal, group, which);
        REQUIRE(actual.reason.empty());
        count += differing(actual.visibility, expected);
    }
    return count;
}

} // namespace

TEST_CASE("Vulkan equals scalar C++ for every depth and normal, filtered or not")
{
    const g_buffer g = random_g_buffer(width, height, 1);
    for (const depth_kind& d : depth_kinds) {
        for (const normal_kind& n : normal_kinds) {
            for (const int filter : { 1, 5 }) {
                INFO("depth " << static_cast<int>(d.source) << "/" << static_cast<int>(d.format) << ", normals "
                              << static_cast<int>(n.source) << "/" << static_cast<int>(n.format) << ", filter " << filter);
                CHECK(difference(make_job(d, n, filter), g) == 0);
            }
        }
    }
    CHECK_THAT(validated_device().messages(), Catch::Matchers::Equals(std::vector<std::string>{}));
}

TEST_CASE("Vulkan equals scalar C++ for every kernel, option and output")
{
    const g_buffer g = random_g_buffer(width, height, 2);
    for (const auto kernel : { ao::method::box, ao::method::hemisphere, ao::method::halton }) {
        for (const int option : { 0, 1, 2, 3 }) {
            for (const auto output : { pixel_format::r32f, pixel_format::r8 }) {
                for (const int filter : { 1, 3 }) {
                    job j = make_job(depth_kinds[3], normal_kinds[0], filter);
                    j.settings.method = kernel;
                    j.settings.seed = 7;
                    j.settings.taps = option == 0 ? 1 : 33;
                    j.settings.thickness = option == 1 ? 0.3F : j.settings.thickness;
                    j.facts.world_normals = option == 2;
                    j.facts.parallel = option == 3;
                    j.facts.output_format = output;
                    j.camera = test_camera(j.facts.parallel);
                    INFO("kernel " << static_cast<int>(kernel) << ", option " << option << ", output " << static_cast<int>(output)
                                   << ", filter " << filter);
                    CHECK(difference(j, g) == 0);
                }
            }
        }
    }
    CHECK_THAT(validated_device().messages(), Catch::Matchers::Equals(std::vector<std::string>{}));
}

TEST_CASE("the size of compute groups changes no bit, whatever the size of the picture")
{
    const int sizes[][2] = { { 1, 1 }, { 1, 37 }, { 53, 1 }, { 31, 17 }, { 130, 9 } };
    for (const auto& size : sizes) {
        const g_buffer g = random_g_buffer(size[0], size[1], 3);
        for (const ao::vk::group_size group :
             { ao::vk::group_size{ 1, 1 }, { 8, 8 }, { 16, 8 }, { 16, 16 }, { 32, 4 }, { 64, 1 }, { 3, 5 }, { 1, 128 } }) {
            job j = make_job(depth_kinds[1], normal_kinds[4], 5);
            j.facts.width = size[0];
            j.facts.height = size[1];
            INFO(size[0] << "x" << size[1] << " in groups of " << group.x << "x" << group.y);
            CHECK(difference(j, g, group) == 0);
        }
    }
    CHECK_THAT(validated_device().messages(), Catch::Matchers::Equals(std::vector<std::string>{}));
}

TEST_CASE("poisoned depths and normals leave scalar C++ and Vulkan alike")
{
    const float inf = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float poison[] = { nan, inf, -inf, -1.0F, 3e38F, 1e-37F, 0.0F };
    for (const depth_kind& d : { depth_kinds[0], depth_kinds[3], depth_kinds[5] }) {
        job j = make_job(d, { normal_source::vector, pixel_format::rgba32f }, 5);
        const g_buffer g = random_g_buffer(width, height, 4);
        ao::picture depth = ao::pack_depth(g.depth, width, height, d.source, d.format, j.camera.projection);
        ao::picture normal = ao::pack_normals(g.normals, width, height, normal_source::vector, pixel_format::rgba32f);
        for (std::size_t i = 0; i < depth.pixels(); i += 5) {
            const float bad = poison[i / 5 % std::size(poison)];
            if (d.format == pixel_format::rgba32f) {
                depth.set_texel(i, glm::vec4(bad));
            }
            else {
                depth.set_texel(i, bad);
            }
            normal.set_texel(i + 2 < depth.pixels() ? i + 2 : i, glm::vec4(0.5F, bad, -bad, bad));
        }
        const auto plan = ao::make_plan(j.settings, j.facts, j.camera);
        REQUIRE(plan);
        const ao::picture expected = ao::conformance::reference_visibility(*plan, depth, normal);
        for (const auto which : { vk_runner::shaders::of_device, vk_runner::shaders::of_gpu }) {
            const auto actual = vk_runner::run(validated_device(), j.settings, j.facts, j.camera, depth, normal, {}, which);
            REQUIRE(actual.reason.empty());
            INFO("depth " << static_cast<int>(d.source));
            CHECK(differing(actual.visibility, expected) == 0);
            for (std::size_t i = 0; i < actual.visibility.pixels(); ++i) {
                const float v = actual.visibility.texel<float>(i);
                REQUIRE((v >= 0 && v <= 1));
            }
        }
    }
}
