// Vulkan's geometry pass.
#include "ao/vk/rasterizer.hpp"
#include "unit/raster_bad_input.hpp"
#include "unit/vk_pictures.hpp"

#include <array>
#include <cstring>
#include <string>
#include <vector>

using namespace vk_test;
using namespace raster_test;
using vk_test::differing;

namespace {

// A device without anything that the rasterizer can do without.
ao::host::vulkan_device& plain_device()
{
    static auto made = ao::host::vulkan_device::create({ "", true, false });
    REQUIRE(made);
    return **made;
}

ao::vk::enabled_features enabled_by(const ao::host::vulkan_device& of)
{
    return { of.dynamic_rendering, of.extended_dynamic_state, of.features.multiDrawIndirect != VK_FALSE,
             of.features.drawIndirectFirstInstance != VK_FALSE };
}

ao::vk::rasterizer rasterizer(ao::host::vulkan_device& on, const ao::vk::enabled_features& enabled,
                              const ao::vk::raster_options& o = {})
{
    ao::vk::context c = vk_runner::context_of(on);
    c.enabled = enabled;
    auto made = ao::vk::rasterizer::create(c, o);
    REQUIRE(made);
    return std::move(*made);
}

ao::vk::rasterizer rasterizer(ao::host::vulkan_device& on = device(), const ao::vk::raster_options& o = {})
{
    return rasterizer(on, enabled_by(on), o);
}

// The targets that facts ask for; the others are null.
struct target_pictures {
    target_pictures(ao::host::vulkan_device& on, const ao::gbuffer_facts& f, bool general = false)
    {
        const VkImageLayout color = general ? VK_IMAGE_LAYOUT_GENERAL : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        const VkImageLayout deep = general ? VK_IMAGE_LAYOUT_GENERAL : VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
        const auto add = [&](bool wanted, pixel_format format, VkImageLayout layout) {
            if (!wanted) {
                return ao::vk::image{};
            }
            kept.push_back(make_image(format, f.width, f.height, layout, on));
            return handle(kept.back());
        };
        kept.reserve(7);
        images.depth = add(true, f.depth_format, deep);
        images.position = add(f.position, f.position_format, color);
        images.normal = add(f.normal, f.normal_format, color);
        images.motion = add(f.motion, f.motion_format, color);
        images.ids = add(f.ids, pixel_format::rg32ui, color);
        images.surface = add(f.surface, pixel_format::rgba32f, color);
        images.frame = add(f.frame, pixel_format::rgba32f, color);
    }
    drawn fetch(const ao::gbuffer_facts& f)
    {
        drawn d;
        std::size_t next = 0;
        const auto one = [&](bool wanted) { return wanted ? download(kept[next++]) : ao::picture(); };
        d.depth = one(true);
        d.position = one(f.position);
        d.normal = one(f.normal);
        d.motion = one(f.motion);
        d.ids = one(f.ids);
        d.surface = one(f.surface);
        d.frame = one(f.frame);
        return d;
    }
    std::vector<ao::host::vulkan_image> kept;
    ao::gbuffer_images<ao::vk::image> images{};
};

struct vk_drawn : drawn {
    std::size_t pipelines = 0;
};

vk_drawn draw(ao::host::vulkan_device& on, ao::vk::rasterizer& vk, const ao::scene& s, const ao::gbuffer_facts& f,
              const ao::gbuffer_camera& camera, bool general = false)
{
    const auto plan = ao::plan_drawing(s, f);
    REQUIRE(plan);
    auto model = vk.load(s, *plan);
    if (!model) {
        FAIL(std::string(model.error().reason()));
    }
    target_pictures pictures(on, f, general);
    auto targets = vk.bind(*model, pictures.images);
    if (!targets) {
        FAIL(std::string(targets.error().reason()));
    }
    REQUIRE(on.submit([&](VkCommandBuffer commands) { vk.record(commands, *model, *targets, camera); }));
    vk_drawn d{ pictures.fetch(f) };
    d.programs = model->programs();
    d.draw_calls = model->draw_calls();
    d.pipelines = model->pipelines();
    d.variants = plan->variants.size();
    return d;
}

draw_function draw_with(ao::host::vulkan_device& on, ao::vk::rasterizer& vk)
{
    return [&](const auto& s, const auto& f, const auto& c) { return draw(on, vk, s, f, c); };
}

void VKAPI_PTR no_x8_d24(VkPhysicalDevice physical, VkFormat format, VkFormatProperties* properties)
{
    vkGetPhysicalDeviceFormatProperties(physical, format, properties);
    if (format == VK_FORMAT_X8_D24_UNORM_PACK32) {
        properties->optimalTilingFeatures = 0;
    }
}

void VKAPI_PTR four_attachments(VkPhysicalDevice physical, VkPhysicalDeviceProperties* properties)
{
    vkGetPhysicalDeviceProperties(physical, properties);
    properties->limits.maxColorAttachments = 4;
}

// The loader of a device that has less than this one.
PFN_vkVoidFunction VKAPI_PTR poor_loader(VkInstance instance, const char* name)
{
    if (std::strcmp(name, "vkGetPhysicalDeviceFormatProperties") == 0) {
        return reinterpret_cast<PFN_vkVoidFunction>(no_x8_d24);
    }
    if (std::strcmp(name, "vkGetPhysicalDeviceProperties") == 0) {
        return reinterpret_cast<PFN_vkVoidFunction>(four_attachments);
    }
    return vkGetInstanceProcAddr(instance, name);
}

} // namespace

TEST_CASE("every Vulkan target is what rays see, by dynamic rendering and by render passes")
{
    REQUIRE(device().dynamic_rendering);
    REQUIRE_FALSE(plain_device().dynamic_rendering);
    for (ao::host::vulkan_device* on : { &device(), &plain_device() }) {
        auto vk = rasterizer(*on);
        check_targets(draw_with(*on, vk));
        check_silence(*on);
    }
}

TEST_CASE("what the host has switched on changes no bit of the picture")
{
    world w = plain_world();
    // Another mesh of a variant that is there already.
    w.meshes.push_back(square(true));
    w.add(3, 0, placed({ 0.3F, -0.2F, -1.5F }, 0.2F, { 0.3F, 0.3F, 1 }));
    const ao::scene s = w.get();
    auto plain = rasterizer(plain_device());
    const auto f = all_targets();
    for (const bool reversed : { false, true }) {
        ao::projection_options o;
        o.reversed = reversed;
        o.y_down = reversed;
        const auto view = camera(o);
        const vk_drawn expected = draw(plain_device(), plain, s, f, view);
        // Three needs, of which two are culled too, four pipelines each.
        CHECK(expected.programs == 3);
        CHECK(expected.pipelines == 16);
        CHECK(expected.draw_calls > expected.variants);
        for (const ao::vk::enabled_features& enabled :
             { enabled_by(device()), ao::vk::enabled_features{ true, false, false, true },
               ao::vk::enabled_features{ false, true, true, true }, ao::vk::enabled_features{ false, true, true, false } }) {
            auto vk = rasterizer(device(), enabled);
            const bool general = enabled.dynamic_rendering != enabled.extended_dynamic_state;
            const vk_drawn d = draw(device(), vk, s, f, view, general);
            INFO("dynamic rendering " << enabled.dynamic_rendering << ", state " << enabled.extended_dynamic_state);
            CHECK(d.programs == 3);
            CHECK(d.pipelines == (enabled.extended_dynamic_state ? 3 : 16));
            const bool indirect = enabled.multi_draw_indirect && enabled.draw_indirect_first_instance;
            CHECK(d.draw_calls == (indirect ? d.variants : expected.draw_calls));
            CHECK(differing(d.depth, expected.depth) == 0);
            CHECK(differing(d.position, expected.position) == 0);
            CHECK(differing(d.normal, expected.normal) == 0);
            CHECK(differing(d.motion, expected.motion) == 0);
            CHECK(differing(d.ids, expected.ids) == 0);
            CHECK(differing(d.surface, expected.surface) == 0);
        }
    }
    check_silence();
    check_silence(plain_device());
}

TEST_CASE("normal maps by Vulkan: mirrored UVs, mirrored and unevenly scaled models, either green, both samplers; alpha is cut")
{
    for (const auto how : { ao::vk::sampling::shared, ao::vk::sampling::hardware }) {
        INFO("sampling " << static_cast<int>(how));
        auto vk = rasterizer(device(), { how });
        check_maps(draw_with(device(), vk));
    }
    check_silence();
}

TEST_CASE("Vulkan programs are as many as the needs, and targets that are off are not looked at")
{
    world w = plain_world();
    auto vk = rasterizer();
    const ao::gbuffer_facts f = all_targets();
    const auto view = camera({});
    const vk_drawn all = draw(device(), vk, w.get(), f, view);
    // Sides, mirroring and a mesh's own normals are no needs of a shader; reading uvs and deforming are.
    CHECK(all.variants == 6);
    CHECK(all.programs == 3);
    CHECK(all.draw_calls == all.variants);
    ao::gbuffer_facts few;
    few.width = width;
    few.height = height;
    few.normal = false;
    const vk_drawn depth = draw(device(), vk, w.get(), few, view);
    CHECK(depth.programs == 1);
    CHECK(depth.pipelines == 1);
    CHECK(differing(depth.depth, all.depth) == 0);
    check_silence();
}

TEST_CASE("each Vulkan target alone, and all but it, hold the bits that all of them together hold")
{
    world w;
    w.meshes.push_back(square(false));
    w.add(0, 0, placed({ 0.2F, 0.1F, -1 }, 0.5F, { 1.5F, 1, 1 }));
    const ao::scene s = w.get();
    const auto view = camera({});
    auto vk = rasterizer();
    ao::gbuffer_facts f = all_targets();
    f.frame = true;
    const vk_drawn all = draw(device(), vk, s, f, view);
    // None, each alone, all but each.
    for (unsigned i = 0; i < 13; ++i) {
        const unsigned set = i == 0 ? 0 : i < 7 ? 1U << (i - 1) : 63U & ~(1U << (i - 7));
        const auto has = [&](unsigned bit) { return (set >> bit & 1U) != 0; };
        f.position = has(0);
        f.normal = has(1);
        f.motion = has(2);
        f.ids = has(3);
        f.surface = has(4);
        f.frame = has(5);
        const vk_drawn d = draw(device(), vk, s, f, view);
        INFO("set " << set);
        CHECK(differing(d.depth, all.depth) == 0);
        const auto same = [&](bool wanted, const ao::picture& a, const ao::picture& b) {
            return !wanted || differing(a, b) == 0;
        };
        CHECK(same(f.position, d.position, all.position));
        CHECK(same(f.normal, d.normal, all.normal));
        CHECK(same(f.motion, d.motion, all.motion));
        CHECK(same(f.ids, d.ids, all.ids));
        CHECK(same(f.surface, d.surface, all.surface));
        CHECK(same(f.frame, d.frame, all.frame));
    }
    check_silence();
}

TEST_CASE("both samplers read the smaller levels of a map")
{
    world w;
    w.meshes.push_back(square(false));
    // A board of two texels whose mean has whole codes: every level but the largest is that mean.
    std::vector<std::uint8_t> board;
    for (int i = 0; i < 64 * 64; ++i) {
        const bool dark = (i + i / 64) % 2 == 0;
        board.insert(board.end(),
                     { std::uint8_t(dark ? 20 : 220), std::uint8_t(dark ? 200 : 100), std::uint8_t(dark ? 240 : 160), 255 });
    }
    w.add_texture(64, board, ao::wrap_mode::repeat);
    w.materials[0].normal_map = 0;
    w.materials[0].repeat = { 16, 16 }; // 1024 texels over some 60 pixels
    w.add(0, 0, placed({ 0, 0, -1 }, 0.2F, { 1.5F, 1, 1 }));
    world mean = w;
    mean.texels[0] = { 120, 150, 200, 255 };
    mean.textures[0].width = mean.textures[0].height = 1;
    const auto view = camera({});
    auto shared = rasterizer();
    const vk_drawn expected = draw(device(), shared, mean.get(), all_targets(), view);
    for (const auto how : { ao::vk::sampling::shared, ao::vk::sampling::hardware }) {
        auto vk = rasterizer(device(), { how });
        const vk_drawn d = draw(device(), vk, w.get(), all_targets(), view);
        INFO("sampling " << static_cast<int>(how));
        int compared = 0;
        for (std::size_t i = 0; i < d.ids.pixels(); ++i) {
            if (d.ids.texel<glm::uvec2>(i).x != 0) {
                ++compared;
                // Texels that are equal leave only the rounding of the weights.
                REQUIRE(static_cast<double>(glm::length(d.normal.texel<glm::vec4>(i) - expected.normal.texel<glm::vec4>(i))) <
                        1e-5);
            }
        }
        CHECK(compared > 500);
    }
    check_silence();
}

TEST_CASE("Vulkan's normals arrive in every format")
{
    auto vk = rasterizer();
    check_normal_formats(draw_with(device(), vk));
    check_silence();
}

TEST_CASE("Vulkan packs the frames of blends that need them, and of nothing else")
{
    world w;
    w.meshes = { square(false), square(true) };
    w.materials.resize(3);
    w.add_texture(1, { 200, 90, 220, 255 }, ao::wrap_mode::repeat);
    w.add_texture(1, { 90, 200, 220, 255 }, ao::wrap_mode::repeat);
    w.materials[0].normal_map = 0;
    w.materials[1].normal_map = 1;
    w.add(0, -1, placed({ -1.3F, 0, 0 }, 0.4F, { 1, 0.6F, 1 }));
    w.add(1, -1, placed({ 1.3F, 0.9F, 0 }, 2.9F, { 1, 0.6F, 3 }));
    w.add(1, 2, placed({ 1.3F, -0.9F, 0 }, 0.4F, { 0.8F, 0.6F, 0.5F }));
    const ao::blend_node blend{ 0, 1, 0.5F, ao::no_texture };
    ao::scene s = w.get();
    s.blends = { &blend, 1 };
    auto f = all_targets();
    f.frame = true;
    auto vk = rasterizer();
    const auto view = camera({});
    const vk_drawn d = draw(device(), vk, s, f, view);
    using real_math = ao::math<float>;
    std::array<int, 4> compared{};
    for (std::size_t i = 0; i < d.ids.pixels(); ++i) {
        const auto ids = d.ids.texel<glm::uvec2>(i);
        const auto frame = d.frame.texel<glm::vec4>(i);
        ++compared[ids.x];
        if (ids.x == 0 || ids.x == 3) {
            REQUIRE(frame == glm::vec4(0));
            continue;
        }
        // The frame and the map of the leaf that gives the geometry its maps, against the normal target.
        const glm::vec3 n = real_math::ao_facing_normal(
            real_math::ao_normal_of_frame(frame, glm::vec3(200, 90, 220) / 255.0F, 1.0F), d.surface.texel<glm::vec4>(i).w);
        REQUIRE(static_cast<double>(glm::length(n - glm::vec3(d.normal.texel<glm::vec4>(i)))) < 1e-5);
    }
    for (const int count : compared) {
        CHECK(count > 50);
    }
    check_silence();
}

TEST_CASE("of surfaces at equal depth Vulkan keeps the first in the plan's order, in either direction of depth")
{
    world w;
    w.meshes = { square(false), square(true) };
    w.materials.resize(2);
    w.materials[1].two_sided = false;
    const glm::mat4 place = placed({ 0.2F, 0.1F, -1 }, 0.5F, { 1.5F, 1, 1 });
    // By variant, then material, then object: 1 and 3 share the first variant's draw, 0 and 2 are culled.
    w.add(0, 1, place);
    w.add(1, 0, place);
    w.add(0, 1, place);
    w.add(1, 0, place);
    const ao::scene s = w.get();
    const auto f = all_targets();
    const auto plan = ao::plan_drawing(s, f);
    REQUIRE(plan);
    const auto first = static_cast<unsigned>(plan->draws.front().object + 1);
    auto vk = rasterizer();
    for (const bool reversed : { false, true }) {
        const vk_drawn d = draw(device(), vk, s, f, camera({ .reversed = reversed }));
        std::size_t seen = 0;
        for (std::size_t i = 0; i < d.ids.pixels(); ++i) {
            const unsigned id = d.ids.texel<glm::uvec2>(i).x;
            seen += id == first ? 1 : 0;
            REQUIRE((id == 0 || id == first));
        }
        CHECK(seen > 500);
    }
    check_silence();
}

TEST_CASE("objects move between frames that are recorded before any has run")
{
    for (ao::host::vulkan_device* on : { &device(), &plain_device() }) {
        world w = plain_world();
        auto first_owner = rasterizer(*on);
        const ao::gbuffer_facts f = all_targets();
        const auto view = camera({});
        const auto plan = ao::plan_drawing(w.get(), f);
        REQUIRE(plan);
        auto loaded = first_owner.load(w.get(), *plan);
        REQUIRE(loaded);
        ao::vk::rasterizer vk = std::move(first_owner);
        ao::vk::raster_model model = std::move(*loaded);
        std::vector<world> worlds{ w, w, w, w };
        for (std::size_t i = 1; i < worlds.size(); ++i) {
            const auto step = 0.2F * static_cast<float>(i);
            auto& o = worlds[i].objects[1];
            o.previous_model = worlds[i - 1].objects[1].model;
            o.model = ao::matrix4(placed({ -1.0F + step, 0.9F, 0.2F }, 0.6F + step, { 1.1F, 1, 1 }));
        }
        std::vector<target_pictures> pictures;
        std::vector<ao::vk::raster_targets> targets;
        for (std::size_t i = 0; i < worlds.size(); ++i) {
            pictures.emplace_back(*on, f);
            auto bound = vk.bind(model, pictures.back().images);
            REQUIRE(bound);
            targets.push_back(std::move(*bound));
        }
        REQUIRE(on->submit([&](VkCommandBuffer commands) {
            for (std::size_t i = 0; i < worlds.size(); ++i) {
                if (i != 0 && vk.move(model, worlds[i].get())) {
                    FAIL("a move is refused");
                }
                vk.record(commands, model, targets[i], view);
            }
        }));
        for (std::size_t i = 0; i < worlds.size(); ++i) {
            INFO("frame " << i);
            compare(worlds[i], view, pictures[i].fetch(f), 1e-6);
        }
        // After these frames have run, the first piece of memory is used again.
        REQUIRE_FALSE(vk.move(model, worlds[1].get()));
        REQUIRE(on->submit([&](VkCommandBuffer commands) { vk.record(commands, model, targets[0], view); }));
        compare(worlds[1], view, pictures[0].fetch(f), 1e-6);
        check_silence(*on);
    }
}

TEST_CASE("Vulkan's rasterizer refuses what no longer fits the plan, and says which")
{
    using Catch::Matchers::Contains;
    world w = plain_world();
    auto vk = rasterizer();
    const ao::gbuffer_facts f = all_targets();
    const auto plan = ao::plan_drawing(w.get(), f);
    REQUIRE(plan);
    auto model = vk.load(w.get(), *plan);
    REQUIRE(model);
    const auto moved_wrong = [&](const ao::scene& s) { return std::string(vk.move(*model, s)->reason()); };
    world mirrored = w;
    mirrored.objects[0].model[0][0] *= -1;
    mirrored.objects[0].model[0][1] *= -1;
    mirrored.objects[0].model[0][2] *= -1;
    CHECK_THAT(moved_wrong(mirrored.get()), Contains("object 0 mirrors now"));
    world fewer = w;
    fewer.objects.pop_back();
    CHECK_THAT(moved_wrong(fewer.get()), Contains("another number of objects"));

    const target_pictures pictures(device(), f);
    REQUIRE(vk.bind(*model, pictures.images));
    using images = ao::gbuffer_images<ao::vk::image>;
    struct part {
        ao::vk::image images::*member;
        const char* name;
    };
    for (const part& each :
         { part{ &images::depth, "depth" }, part{ &images::position, "position" }, part{ &images::normal, "normal" },
           part{ &images::motion, "motion" }, part{ &images::ids, "ids" }, part{ &images::surface, "surface" } }) {
        images bad = pictures.images;
        bad.*each.member = {};
        const auto missing = vk.bind(*model, bad);
        REQUIRE_FALSE(missing);
        CHECK(missing.error().code() == ao::errc::plan_mismatch);
        CHECK_THAT(std::string(missing.error().reason()), Contains(each.name) && Contains("no image view"));
        bad = pictures.images;
        (bad.*each.member).layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
        const auto wrong_layout = vk.bind(*model, bad);
        REQUIRE_FALSE(wrong_layout);
        CHECK_THAT(std::string(wrong_layout.error().reason()), Contains(each.name) && Contains("LAYOUT"));
    }
    ao::draw_plan huge = *plan;
    huge.facts.width = 65536;
    CHECK(vk.load(w.get(), huge).error().code() == ao::errc::invalid_size);
    ao::vk::context incomplete = vk_runner::context_of(device());
    incomplete.device = VK_NULL_HANDLE;
    CHECK(ao::vk::rasterizer::create(incomplete).error().code() == ao::errc::device);
    check_silence();
}

TEST_CASE("what a poorer Vulkan device cannot draw is named")
{
    using Catch::Matchers::Contains;
    world w = plain_world();
    ao::vk::context c = vk_runner::context_of(device());
    c.get_instance_proc_addr = poor_loader;
    auto vk = ao::vk::rasterizer::create(c);
    REQUIRE(vk);
    const auto reason = [&](const ao::gbuffer_facts& f) {
        const auto plan = ao::plan_drawing(w.get(), f);
        REQUIRE(plan);
        const auto model = vk->load(w.get(), *plan);
        return model ? std::string() : std::string(model.error().reason());
    };
    ao::gbuffer_facts f = all_targets();
    CHECK_THAT(reason(f), Contains("5 color attachments") && Contains("has 4"));
    // Those that the plan leaves out take none, wherever they stand.
    f.position = false;
    CHECK(reason(f).empty());
    f.depth_format = pixel_format::d24;
    CHECK_THAT(reason(f), Contains("draw to d24"));

    c = vk_runner::context_of(plain_device());
    c.enabled.dynamic_rendering = true;
    const auto refused = ao::vk::rasterizer::create(c);
    REQUIRE_FALSE(refused);
    CHECK_THAT(std::string(refused.error().reason()), Contains("vkCmdBeginRendering"));
    check_silence();
    check_silence(plain_device());
}

TEST_CASE("a million objects are drawn by Vulkan, each with its own transform and id; an empty scene clears")
{
    auto vk = rasterizer();
    check_many_objects(draw_with(device(), vk), 1000000);
    check_silence();
}

TEST_CASE("Vulkan leaves no mark of triangles without area or with vertices that are not finite, and no NaN of attributes")
{
    auto vk = rasterizer();
    check_bad_triangles(draw_with(device(), vk));
    check_bad_attributes(draw_with(device(), vk));
    check_silence();
}
