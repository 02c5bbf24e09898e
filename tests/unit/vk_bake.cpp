// Ambient occlusion per vertex on Vulkan against the reference, bit for bit.
#include "ao/vk/bake.hpp"
#include "unit/bake_cube_cases.hpp"
#include "unit/vk_pictures.hpp"

#include <string>

using namespace vk_test;
using namespace bake_test;

namespace {

ao::vk::baker make_baker(const ao::vk::context& c, const ao::bake_gpu_options& options = {})
{
    auto made = ao::vk::baker::create(c, { device().queue, device().queue_family }, options);
    REQUIRE(made);
    return std::move(*made);
}

ao::vk::baker make_baker(ao::vk::group_size group = {}, const ao::bake_gpu_options& options = {})
{
    return make_baker(vk_runner::context_of(device(), group), options);
}

void VKAPI_PTR small_properties(VkPhysicalDevice physical, VkPhysicalDeviceProperties* properties)
{
    vkGetPhysicalDeviceProperties(physical, properties);
    properties->limits.maxTexelBufferElements = 100;
}

PFN_vkVoidFunction VKAPI_PTR small_loader(VkInstance instance, const char* name)
{
    if (std::string_view(name) == "vkGetPhysicalDeviceProperties") {
        return reinterpret_cast<PFN_vkVoidFunction>(small_properties);
    }
    return vkGetInstanceProcAddr(instance, name);
}

} // namespace

TEST_CASE("Vulkan bakes as the reference does, in every bit, by every route")
{
    for (const ao::vk::group_size group : { ao::vk::group_size{}, ao::vk::group_size{ 5, 3 } }) {
        auto vk = make_baker(group);
        check_sums([&](const auto& job, const auto& request) { return vk.run(job, request); });
    }
    check_silence();
}

TEST_CASE("Vulkan bakes parts, and meshes of nothing")
{
    auto first_owner = make_baker();
    ao::vk::baker vk = std::move(first_owner);
    check_parts([&](const auto& job, const auto& request) { return vk.run(job, request); });
    check_silence();
}

TEST_CASE("a bake on Vulkan says how far it is, ends when told, and goes on where it ended")
{
    auto vk = make_baker({ 8, 8 }, { .launch_seconds = 1e-9, .scratch = 1 });
    check_progress([&](const auto& job, const auto& request) { return vk.run(job, request); });
    check_silence();
}

TEST_CASE("cube maps on Vulkan are the reference's in every texel that is looked up")
{
    for (const std::uint32_t texels : { 1U, 9U, 24U }) {
        auto vk = make_baker({ 8, 4 }, { .scratch = texels == 9 ? 1U : 1U << 24U, .cube_texels = texels });
        const auto run = [&](const auto& job, const auto& request) { return vk.run(job, request); };
        check_cube(run, static_cast<int>(texels));
        if (texels == 9) {
            check_cube_progress(run);
        }
    }
    check_silence();
}

TEST_CASE("Vulkan refuses to bake what it cannot, and says why")
{
    auto vk = make_baker();
    check_refusals([&](const auto& job, const auto& request) { return vk.run(job, request); });
    CHECK(ao::vk::baker::create(vk_runner::context_of(device()), {}).error().code() == ao::errc::device);
    CHECK(ao::vk::baker::create({}, { device().queue, device().queue_family }).error().code() == ao::errc::device);

    ao::vk::context small = vk_runner::context_of(device());
    small.get_instance_proc_addr = small_loader;
    auto refuses = make_baker(small);
    const auto job = job_of(sphere_on_floor(), *ao::lebedev_rule(6), {});
    const auto sums = refuses.run(job);
    REQUIRE_FALSE(sums);
    CHECK(sums.error().code() == ao::errc::out_of_memory);
    CHECK_THAT(std::string(sums.error().reason()), Catch::Matchers::Contains("vertices") && Catch::Matchers::Contains("100"));
    check_silence();
}
