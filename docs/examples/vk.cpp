#include <ao/vk/backend.hpp>
#include <functional>

// Views of a D32_SFLOAT, an R16G16B16A16_SFLOAT and an R32_SFLOAT image. `next_frame` gives a command buffer outside a render
// pass, or null once the device is idle.
std::optional<ao::error> run_vk(const ao::vk::context& host, const ao::host_images<ao::vk::image>& views, int width, int height,
                                const std::function<VkCommandBuffer(ao::camera&)>& next_frame)
{
    ao::camera camera{ .projection = ao::make_projection({}, { .reversed = true, .y_down = true }) };
    auto vk = ao::vk::backend::create(host);
    if (!vk) return vk.error();
    const ao::facts facts{
        .width = width, .height = height, .depth = ao::depth_source::hardware, .depth_format = ao::pixel_format::d32f
    };
    auto effect = ao::effect<ao::vk::backend>::create(*vk, ao::settings{ .radius = 1.0F }, facts, camera);
    if (!effect) return effect.error();
    auto images = effect->bind(views);
    if (!images) return images.error();
    while (VkCommandBuffer commands = next_frame(camera)) {
        if (auto wrong = effect->set_camera(camera)) return wrong;
        effect->record(commands, *images); // compute dispatches and their barriers
    }
    return std::nullopt;
}
