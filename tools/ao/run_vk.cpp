#include "ao/run_frames.hpp"
#include "ao/vk/backend.hpp"
#include "host/vulkan_timer.hpp"

namespace ao::tools {

run_outcome run_vk(const run_inputs& in, const std::string& device_name)
{
    const auto device = take("vk", host::vulkan_device::create({ device_name, false }));
    const auto image = [&](const picture& p, VkImageLayout layout) {
        auto i = take("vk", host::vulkan_image::create(*device, p.format,
                                                       { static_cast<unsigned>(p.width), static_cast<unsigned>(p.height) }));
        (void)take("vk", i.upload(p.bytes, layout));
        return i;
    };
    constexpr VkImageLayout read_only = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    const auto depth = image(in.depth, read_only);
    std::optional<host::vulkan_image> normal;
    if (in.facts.normals != normal_source::from_depth)
        normal = image(in.normal, read_only);
    picture visibility(in.facts.output_format, in.facts.width, in.facts.height);
    auto target = image(visibility, VK_IMAGE_LAYOUT_GENERAL);

    vk::context context;
    context.instance = device->instance;
    context.physical_device = device->physical;
    context.device = device->device;
    context.get_instance_proc_addr = vkGetInstanceProcAddr;
    auto backend = take("vk", vk::backend::create(context));

    run_outcome out;
    out.label = out.backend = "vk";
    out.device = device->name();
    out.route = "compute";

    const stopwatch since;
    auto effect = take("vk", ao::effect<vk::backend>::create(backend, in.settings, in.facts, in.camera));
    auto bound = take("vk", effect.bind({ { depth.view, depth.layout },
                                          { normal ? normal->view : VK_NULL_HANDLE, read_only },
                                          { target.view, VK_IMAGE_LAYOUT_GENERAL } }));
    const std::size_t passes = effect.current_plan().passes.size();
    auto timer = take("vk", host::vulkan_timer::create(*device, static_cast<std::uint32_t>(passes + 1)));
    time_frames(out, effect.current_plan(), in.frames, since, [&] {
        const auto record = [&](VkCommandBuffer commands) {
            timer.record_reset(commands);
            timer.record_mark(commands);
            for (std::size_t i = 0; i < passes; ++i) {
                effect.record_pass(commands, bound, i);
                timer.record_mark(commands);
            }
        };
        (void)take("vk", device->submit(record));
        return take("vk", timer.read());
    });
    (void)take("vk", target.download(visibility.bytes));
    out.visibility = floats_of(visibility);
    return out;
}

} // namespace ao::tools
