// Temporal ambient occlusion on Vulkan against the reference executor, bit for bit, with the validation layer listening.
#include "ao/vk/temporal.hpp"
#include "unit/cpu_allocations.hpp"
#include "unit/temporal_cases.hpp"
#include "unit/vk_pictures.hpp"

#include <array>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

using namespace vk_test;
using namespace temporal_test;
using Catch::Matchers::Contains;

namespace {

ao::vk::temporal executor_on(const ao::vk::context& c)
{
    auto made = ao::vk::temporal::create(c);
    REQUIRE(made);
    return std::move(*made);
}

// A frame's pictures on the device, bound; what the plan does not read is not handed over.
class bound_frame {
public:
    bound_frame(ao::vk::temporal& on, ao::vk::temporal_program& program, const ao::temporal_plan& p,
                const ao::conformance::temporal_inputs& in)
        : depth_(upload(in.depth)),
          visibility_(make_image(p.facts.frame.output_format, p.facts.frame.width, p.facts.frame.height, VK_IMAGE_LAYOUT_GENERAL))
    {
        images.depth = handle(depth_);
        if (p.facts.frame.normals != ao::normal_source::from_depth) {
            normal_.emplace(upload(in.normal));
            images.normal = handle(*normal_);
        }
        if (p.facts.motion) {
            motion_.emplace(upload(in.motion));
            images.motion = handle(*motion_);
        }
        images.visibility = handle(visibility_);
        auto bound = on.bind_temporal(program, p, images);
        REQUIRE(bound);
        binding.emplace(std::move(*bound));
    }
    ao::picture visibility() { return download(visibility_); }

    ao::temporal_images<ao::vk::image> images;
    std::optional<ao::vk::temporal_binding> binding;

private:
    ao::host::vulkan_image depth_, visibility_;
    std::optional<ao::host::vulkan_image> normal_, motion_;
};

// All frames of a case in one command buffer, each with a binding of its own, and after each a copy of the history. No barrier
// is the host's but the one for its own reads at the end.
void check_one_submission(const temporal_case& c, const ao::vk::context& context)
{
    INFO(c.name);
    ao::vk::temporal first_owner = executor_on(context);
    auto planned = ao::make_temporal_plan(c.settings, c.facts);
    REQUIRE(planned);
    ao::temporal_plan plan = *planned;
    auto prepared = first_owner.prepare_temporal(plan);
    REQUIRE(prepared);
    ao::vk::temporal vk = std::move(first_owner);
    ao::vk::temporal_program program = std::move(*prepared);

    const std::vector<sequence_frame> frames = make_sequence(c);
    std::vector<bound_frame> bound;
    for (const sequence_frame& each : frames) {
        bound.emplace_back(vk, program, plan, each.frame.inputs);
    }
    const VkDeviceSize size = ao::history_bytes(plan);
    auto histories = ao::host::vulkan_buffer::create(device(), size * frames.size(), VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    REQUIRE(histories);
    ao::temporal_state state;
    std::vector<std::size_t> steps;
    REQUIRE(device().submit([&](VkCommandBuffer commands) {
        for (std::size_t i = 0; i < frames.size(); ++i) {
            const auto next = ao::next_frame(plan, state, frames[i].frame.camera, frames[i].cut);
            REQUIRE(next);
            steps.push_back(next->steps.size());
            for (std::size_t k = 0; k < next->steps.size(); ++k) {
                vk.record_temporal(commands, program, *bound[i].binding, plan, *next, k);
            }
            const VkBufferCopy whole{ 0, size * i, size };
            vkCmdCopyBuffer(commands, program.history(state.latest), histories->buffer, 1, &whole);
        }
        VkMemoryBarrier barrier{};
        barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
        barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
        barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
        vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, nullptr, 0,
                             nullptr);
    }));

    executor reference = make_executor(c.settings, c.facts);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        INFO("frame " << i);
        const picture& expected = reference.run(frames[i].frame.inputs, frames[i].frame.camera, frames[i].cut);
        REQUIRE(steps[i] == reference.steps());
        REQUIRE(reference.history().size() * sizeof(std::uint32_t) == size);
        REQUIRE(std::memcmp(histories->bytes.data() + size * i, reference.history().data(), size) == 0);
        if (steps[i] != 0) {
            REQUIRE(differing(bound[i].visibility(), stored_visibility(expected, c.facts.frame.output_format)) == 0);
        }
    }
    check_silence();
}

bool without_motion = false;

void VKAPI_PTR poor_properties(VkPhysicalDevice of, VkPhysicalDeviceProperties* properties)
{
    vkGetPhysicalDeviceProperties(of, properties);
    properties->limits.maxStorageBufferRange = 4096;
}

void VKAPI_PTR poor_formats(VkPhysicalDevice of, VkFormat format, VkFormatProperties* properties)
{
    vkGetPhysicalDeviceFormatProperties(of, format, properties);
    if (without_motion && format == VK_FORMAT_R32G32_SFLOAT) {
        properties->optimalTilingFeatures = 0;
    }
}

// The loader of a device that has less than this one.
PFN_vkVoidFunction VKAPI_PTR poor_loader(VkInstance instance, const char* name)
{
    if (std::strcmp(name, "vkGetPhysicalDeviceProperties") == 0) {
        return reinterpret_cast<PFN_vkVoidFunction>(poor_properties);
    }
    if (std::strcmp(name, "vkGetPhysicalDeviceFormatProperties") == 0) {
        return reinterpret_cast<PFN_vkVoidFunction>(poor_formats);
    }
    return vkGetInstanceProcAddr(instance, name);
}

} // namespace

TEST_CASE("Vulkan's temporal passes equal the reference in every bit of visibility and history, through the runner")
{
    auto made = ao::host::make_vk_temporal_runner({ .device = {}, .validation = true });
    REQUIRE(made);
    ao::host::temporal_runner& runner = **made;
    CHECK(runner.backend() == "vk");
    check_cases(runner);
    check_rest(runner);
    check_bad_requests(runner);
    CHECK_THAT(runner.messages(), Catch::Matchers::Equals(std::vector<std::string>{}));
}

TEST_CASE("frames in one command buffer, each with its own binding, give the same bits without a wait, with either shaders")
{
    for (const temporal_case& c : temporal_cases()) {
        if (!c.poison) {
            check_one_submission(c, vk_runner::context_of(device(), {}, vk_runner::shaders::of_gpu));
        }
    }
    check_one_submission(base_case("for CPUs"), vk_runner::context_of(device()));
    check_one_submission(base_case("for CPUs, in groups of 7x4", false), vk_runner::context_of(device(), { 7, 4 }));
    ao::vk::context copied = vk_runner::context_of(device(), {}, vk_runner::shaders::of_gpu);
    copied.readers = VK_PIPELINE_STAGE_TRANSFER_BIT;
    check_one_submission(base_case("for readers that copy"), copied);
}

TEST_CASE("the histories of poisoned frames are the reference's with the shaders for GPUs too")
{
    for (temporal_case c : temporal_cases()) {
        if (c.poison) {
            // Pictures only: the history keeps what they leave in it.
            check_one_submission(c, vk_runner::context_of(device(), {}, vk_runner::shaders::of_gpu));
        }
    }
}

#if defined(AO_COUNTS_ALLOCATIONS)
// Whatever recording allocates by operator new, in the library or in a driver, fails it.
TEST_CASE("recording a temporal frame on Vulkan allocates nothing")
{
    // The validation layer allocates.
    const auto quiet = ao::host::vulkan_device::create();
    REQUIRE(quiet);
    ao::host::vulkan_device& on = **quiet;
    temporal_case c = base_case("allocations");
    c.frames = 12; // the filter runs, too
    const std::vector<sequence_frame> frames = make_sequence(c);
    const ao::conformance::temporal_inputs& first = frames[0].frame.inputs;
    const auto sampled = [&](const ao::picture& from) {
        return vk_runner::upload(on, from, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    };
    const auto depth = sampled(first.depth);
    const auto normal = sampled(first.normal);
    const auto motion = sampled(first.motion);
    const auto visibility =
        make_image(c.facts.frame.output_format, c.facts.frame.width, c.facts.frame.height, VK_IMAGE_LAYOUT_GENERAL, on);
    ao::vk::temporal vk = executor_on(vk_runner::context_of(on));
    auto made = ao::temporal_effect<ao::vk::temporal>::create(vk, c.settings, c.facts);
    REQUIRE(made);
    auto bound = made->bind({ handle(depth), handle(normal), handle(motion), handle(visibility) });
    REQUIRE(bound);
    int allocated = 0;
    bool failed = false;
    REQUIRE(on.submit([&](VkCommandBuffer commands) {
        for (const sequence_frame& each : frames) {
            const int before = cpu_test::allocations();
            failed = made->record(commands, *bound, each.frame.camera).has_value() || failed;
            allocated += cpu_test::allocations() - before;
        }
    }));
    CHECK_FALSE(failed);
    CHECK(allocated == 0);
}
#endif

TEST_CASE("Vulkan's temporal passes refuse pictures and plans that do not fit, and say which")
{
    ao::vk::temporal vk = executor_on(vk_runner::context_of(device()));
    const temporal_case c = base_case("refused");
    const auto plan = ao::make_temporal_plan(c.settings, c.facts);
    REQUIRE(plan);
    auto program = vk.prepare_temporal(*plan);
    REQUIRE(program);
    CHECK(program->history(0) != program->history(1));
    const bound_frame own(vk, *program, *plan, make_sequence(c)[0].frame.inputs);

    using images = ao::temporal_images<ao::vk::image>;
    const auto reason = [&](const images& with, const ao::temporal_plan& p) {
        const auto bound = vk.bind_temporal(*program, p, with);
        REQUIRE_FALSE(bound);
        CHECK(bound.error().code() == ao::errc::plan_mismatch);
        return std::string(bound.error().reason());
    };
    struct part {
        ao::vk::image images::*member;
        const char* name;
    };
    for (const part& each : { part{ &images::depth, "depth" }, part{ &images::normal, "normals" },
                              part{ &images::motion, "motion" }, part{ &images::visibility, "visibility" } }) {
        images bad = own.images;
        bad.*each.member = {};
        CHECK_THAT(reason(bad, *plan), Contains(each.name));
    }
    images bad = own.images;
    bad.visibility.layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    CHECK_THAT(reason(bad, *plan), Contains("GENERAL"));

    // A program serves settings that only go into constants.
    ao::temporal_settings other = c.settings;
    other.radius = 2;
    CHECK(vk.bind_temporal(*program, *ao::make_temporal_plan(other, c.facts), own.images));
    other.period = 100;
    CHECK_THAT(reason(own.images, *ao::make_temporal_plan(other, c.facts)), Contains("structure"));
    other = c.settings;
    other.filter = 1;
    CHECK_THAT(reason(own.images, *ao::make_temporal_plan(other, c.facts)), Contains("structure"));
    check_silence();
}

TEST_CASE("Vulkan's temporal passes say what the device cannot do")
{
    CHECK(ao::vk::temporal::create({}).error().code() == ao::errc::device);
    ao::vk::context poor = vk_runner::context_of(device());
    poor.get_instance_proc_addr = poor_loader;
    ao::vk::temporal vk = executor_on(poor);
    temporal_case c = base_case("too much", true, 16, 16);
    c.settings.period = 32;
    c.facts.motion_format = ao::pixel_format::rg32f;
    const auto prepare = [&] { return vk.prepare_temporal(*ao::make_temporal_plan(c.settings, c.facts)); };
    CHECK(prepare());
    without_motion = true;
    const auto unsupported = prepare();
    without_motion = false;
    REQUIRE_FALSE(unsupported);
    CHECK(unsupported.error().code() == ao::errc::unsupported_format);
    CHECK_THAT(std::string(unsupported.error().reason()), Contains("rg32f"));
    c.facts.frame.width = 17;
    const auto refused = prepare();
    REQUIRE_FALSE(refused);
    CHECK(refused.error().code() == ao::errc::out_of_memory);
    CHECK_THAT(std::string(refused.error().reason()), Contains("history") && Contains("4352") && Contains("4096"));
    c.facts.frame.width = 65536;
    CHECK(prepare().error().code() == ao::errc::invalid_size);
}
