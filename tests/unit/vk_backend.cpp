// What the Vulkan backend promises its host beside the picture: errors in words, reuse, moves, a silent validation layer.
#include "support/vk_runner.hpp"

#include <catch2/catch.hpp>

#include <cstring>

namespace {

using ao::errc;
using ao::pixel_format;
using Catch::Matchers::Contains;
using ao_effect = ao::effect<ao::vk::backend>;

ao::host::vulkan_device& validated_device()
{
    static auto device = ao::host::vulkan_device::create({ "", true });
    REQUIRE(device);
    return **device;
}

ao::vk::backend make_backend()
{
    auto backend = ao::vk::backend::create(vk_runner::context_of(validated_device()));
    REQUIRE(backend);
    return std::move(*backend);
}

ao::camera test_camera()
{
    ao::camera view;
    view.projection = ao::make_projection({ -0.8, 0.8, -0.6, 0.6, 0.1, 50 });
    return view;
}

ao::facts test_facts(int width, int height)
{
    ao::facts f;
    f.width = width;
    f.height = height;
    f.normals = ao::normal_source::from_depth;
    return f;
}

ao::plan make_plan(const ao::facts& f, const ao::settings& s = {})
{
    const auto plan = ao::make_plan(s, f, test_camera());
    REQUIRE(plan);
    return *plan;
}

// A step in depth, `shift` pixels from the left.
ao::picture step(int width, int height, int shift)
{
    ao::picture depth(pixel_format::r32f, width, height);
    for (std::size_t i = 0; i < depth.pixels(); ++i) {
        depth.set_texel(i, static_cast<int>(i) % width < shift ? 3.0F : 3.4F);
    }
    return depth;
}

bool without_format = false;
bool without_feature = false;

void VKAPI_PTR poor_formats(VkPhysicalDevice device, VkFormat format, VkFormatProperties* properties)
{
    vkGetPhysicalDeviceFormatProperties(device, format, properties);
    if (without_format && (format == VK_FORMAT_X8_D24_UNORM_PACK32 || format == VK_FORMAT_D24_UNORM_S8_UINT)) {
        properties->optimalTilingFeatures = 0;
    }
}

void VKAPI_PTR poor_features(VkPhysicalDevice device, VkPhysicalDeviceFeatures* features)
{
    vkGetPhysicalDeviceFeatures(device, features);
    features->shaderStorageImageExtendedFormats = without_feature ? VK_FALSE : features->shaderStorageImageExtendedFormats;
}

// The loader of a device that has less than this one.
PFN_vkVoidFunction VKAPI_PTR poor_loader(VkInstance instance, const char* name)
{
    if (std::strcmp(name, "vkGetPhysicalDeviceFormatProperties") == 0) {
        return reinterpret_cast<PFN_vkVoidFunction>(poor_formats);
    }
    if (std::strcmp(name, "vkGetPhysicalDeviceFeatures") == 0) {
        return reinterpret_cast<PFN_vkVoidFunction>(poor_features);
    }
    return vkGetInstanceProcAddr(instance, name);
}

PFN_vkVoidFunction VKAPI_PTR empty_loader(VkInstance, const char*)
{
    return nullptr;
}

} // namespace

TEST_CASE("an incomplete Vulkan context is refused")
{
    ao::vk::context c = vk_runner::context_of(validated_device());
    c.device = VK_NULL_HANDLE;
    CHECK(ao::vk::backend::create(c).error().code() == errc::device);
    c = vk_runner::context_of(validated_device());
    c.get_instance_proc_addr = empty_loader;
    const auto unknown = ao::vk::backend::create(c);
    REQUIRE_FALSE(unknown);
    CHECK_THAT(std::string(unknown.error().reason()), Contains("vkGetDeviceProcAddr"));
}

TEST_CASE("compute groups that the device does not allow are refused")
{
    for (const ao::vk::group_size group : { ao::vk::group_size{ 0, 8 }, { 8, 0 }, { 1U << 20U, 1 }, { 1U << 16U, 1U << 16U } }) {
        const auto refused = ao::vk::backend::create(vk_runner::context_of(validated_device(), group));
        REQUIRE_FALSE(refused);
        CHECK(refused.error().code() == errc::invalid_size);
    }
}

TEST_CASE("pictures beyond the device's limit are refused")
{
    ao::vk::backend backend = make_backend();
    const auto refused = backend.prepare(make_plan(test_facts(65536, 2)));
    REQUIRE_FALSE(refused);
    CHECK(refused.error().code() == errc::invalid_size);
    CHECK_THAT(std::string(refused.error().reason()), Contains("65536x2") && Contains("limit"));
}

TEST_CASE("formats that the device lacks are named")
{
    ao::vk::context c = vk_runner::context_of(validated_device());
    c.get_instance_proc_addr = poor_loader;
    const auto reason = [&](const ao::facts& f, int filter) {
        auto backend = ao::vk::backend::create(c);
        REQUIRE(backend);
        ao::settings s;
        s.filter = filter;
        const auto program = backend->prepare(make_plan(f, s));
        if (program) {
            return std::string();
        }
        CHECK(program.error().code() == errc::unsupported_format);
        return std::string(program.error().reason());
    };
    ao::facts d24 = test_facts(8, 8);
    d24.depth = ao::depth_source::hardware;
    d24.depth_format = pixel_format::d24;
    ao::facts r8 = test_facts(8, 8);
    r8.output_format = pixel_format::r8;

    CHECK(reason(d24, 5).empty());
    CHECK(reason(r8, 1).empty());
    without_format = true;
    CHECK_THAT(reason(d24, 5), Contains("sample") && Contains("d24"));
    without_format = false;
    without_feature = true;
    CHECK_THAT(reason(r8, 1), Contains("store") && Contains("r8"));
    CHECK_THAT(reason(test_facts(8, 8), 5), Contains("store") && Contains("rg32f"));
    CHECK(reason(test_facts(8, 8), 1).empty());
    without_feature = false;
}

TEST_CASE("bindings that do not fit the plan are refused")
{
    ao::vk::backend backend = make_backend();
    ao::facts f = test_facts(8, 8);
    f.normals = ao::normal_source::vector;
    const ao::plan plan = make_plan(f);
    auto program = backend.prepare(plan);
    REQUIRE(program);
    const auto image = vk_runner::upload(validated_device(), step(8, 8, 4), VK_IMAGE_LAYOUT_GENERAL);
    const ao::vk::image good{ image.view, VK_IMAGE_LAYOUT_GENERAL };
    const auto code = [&](const ao::plan& p, const ao::host_images<ao::vk::image>& images) {
        const auto bound = backend.bind(*program, p, images);
        REQUIRE_FALSE(bound);
        return bound.error().code();
    };
    CHECK(code(plan, { {}, good, good }) == errc::plan_mismatch);
    CHECK(code(plan, { good, {}, good }) == errc::plan_mismatch);
    CHECK(code(plan, { good, good, {} }) == errc::plan_mismatch);
    CHECK(code(plan, { good, good, { image.view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL } }) == errc::plan_mismatch);
    ao::settings other;
    other.taps = 7;
    CHECK(code(make_plan(f, other), { good, good, good }) == errc::plan_mismatch);
}

TEST_CASE("frames in one command buffer, two bindings of one program and moved objects give the same pictures")
{
    ao::host::vulkan_device& device = validated_device();
    const ao::facts f = test_facts(70, 40);
    const ao::settings s;
    const ao::picture depths[] = { step(f.width, f.height, 20), step(f.width, f.height, 50) };
    const auto first = vk_runner::run(device, s, f, test_camera(), depths[0], {});
    const auto second = vk_runner::run(device, s, f, test_camera(), depths[1], {});
    REQUIRE(first.reason.empty());
    REQUIRE(second.reason.empty());
    REQUIRE(first.visibility.bytes != second.visibility.bytes);

    ao::vk::backend original = make_backend();
    auto program = original.prepare(make_plan(f, s));
    REQUIRE(program);
    ao::vk::backend backend = std::move(original);
    ao::vk::program moved = std::move(*program);
    const ao::plan plan = make_plan(f, s);

    std::vector<ao::host::vulkan_image> images;
    std::vector<ao::vk::binding> bindings;
    for (const ao::picture& depth : depths) {
        images.push_back(vk_runner::upload(device, depth, VK_IMAGE_LAYOUT_GENERAL));
        images.push_back(vk_runner::upload(device, ao::picture(pixel_format::r32f, f.width, f.height), VK_IMAGE_LAYOUT_GENERAL));
        const ao::vk::image in{ images[images.size() - 2].view, VK_IMAGE_LAYOUT_GENERAL };
        const ao::vk::image out{ images.back().view, VK_IMAGE_LAYOUT_GENERAL };
        auto bound = backend.bind(moved, plan, { in, {}, out });
        REQUIRE(bound);
        bindings.push_back(std::move(*bound));
    }
    REQUIRE(device.submit([&](VkCommandBuffer commands) {
        for (int frame = 0; frame < 3; ++frame) {
            for (ao::vk::binding& each : bindings) {
                for (std::size_t i = 0; i < plan.passes.size(); ++i) {
                    backend.record_pass(commands, moved, each, plan, i);
                }
            }
            // The next frame writes the visibility again.
            VkMemoryBarrier barrier{};
            barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
            barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
            barrier.dstAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
            vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0, 1,
                                 &barrier, 0, nullptr, 0, nullptr);
        }
    }));
    ao::picture back(pixel_format::r32f, f.width, f.height);
    REQUIRE(images[1].download(back.bytes));
    CHECK(back.bytes == first.visibility.bytes);
    REQUIRE(images[3].download(back.bytes));
    CHECK(back.bytes == second.visibility.bytes);
    CHECK_THAT(device.messages(), Catch::Matchers::Equals(std::vector<std::string>{}));
}

TEST_CASE("settings and camera change without preparing anew")
{
    ao::host::vulkan_device& device = validated_device();
    const ao::facts f = test_facts(70, 40);
    const ao::picture depth = step(f.width, f.height, 30);
    ao::settings wide;
    wide.radius = 0.7F;
    ao::settings narrow = wide;
    narrow.radius = 0.2F;
    const auto expected = vk_runner::run(device, narrow, f, test_camera(), depth, {});
    REQUIRE(expected.reason.empty());

    ao::vk::backend backend = make_backend();
    auto effect = ao_effect::create(backend, wide, f, test_camera());
    REQUIRE(effect);
    const auto in = vk_runner::upload(device, depth, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    auto out = vk_runner::upload(device, depth, VK_IMAGE_LAYOUT_GENERAL);
    auto bound = effect->bind({ { in.view, in.layout }, {}, { out.view, out.layout } });
    REQUIRE(bound);
    ao::picture back(pixel_format::r32f, f.width, f.height);
    REQUIRE(device.submit([&](VkCommandBuffer commands) { effect->record(commands, *bound); }));
    REQUIRE(out.download(back.bytes));
    CHECK(back.bytes != expected.visibility.bytes);
    REQUIRE_FALSE(effect->set_settings(narrow, test_camera()));
    REQUIRE(device.submit([&](VkCommandBuffer commands) { effect->record(commands, *bound); }));
    REQUIRE(out.download(back.bytes));
    CHECK(back.bytes == expected.visibility.bytes);
    CHECK_THAT(device.messages(), Catch::Matchers::Equals(std::vector<std::string>{}));
}
