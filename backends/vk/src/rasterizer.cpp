#include "raster_state.hpp"

#include <cstdio>
#include <new>
#include <utility>

namespace ao::vk {

raster_model::raster_model(std::unique_ptr<raster_model_state> state) : state_(std::move(state)) {}
raster_model::raster_model(raster_model&&) noexcept = default;
raster_model& raster_model::operator=(raster_model&&) noexcept = default;
raster_model::~raster_model() = default;
std::size_t raster_model::programs() const
{
    return state_->programs;
}
std::size_t raster_model::pipelines() const
{
    return state_->pipelines.size();
}
std::size_t raster_model::draw_calls() const
{
    return state_->draw_calls;
}

raster_targets::raster_targets(std::unique_ptr<raster_targets_state> state) : state_(std::move(state)) {}
raster_targets::raster_targets(raster_targets&&) noexcept = default;
raster_targets& raster_targets::operator=(raster_targets&&) noexcept = default;
raster_targets::~raster_targets() = default;

rasterizer::rasterizer(std::unique_ptr<device> d, const raster_options& chosen) : device_(std::move(d)), options_(chosen) {}
rasterizer::rasterizer(rasterizer&&) noexcept = default;
rasterizer& rasterizer::operator=(rasterizer&&) noexcept = default;
rasterizer::~rasterizer() = default;

result<rasterizer> rasterizer::create(const context& c, const raster_options& chosen)
{
    auto made = make_device(c);
    if (!made) {
        return made.error();
    }
    return rasterizer(std::move(*made), chosen);
}

namespace {

std::optional<error> wrong_image(const image& given, const char* role, bool depth)
{
    char text[160];
    if (given.view == VK_NULL_HANDLE) {
        std::snprintf(text, sizeof text, "the plan needs a %s picture, but there is no image view of it", role);
        return error(errc::plan_mismatch, text);
    }
    const VkImageLayout own = depth ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    if (given.layout != own && given.layout != VK_IMAGE_LAYOUT_GENERAL) {
        std::snprintf(text, sizeof text, "%s is drawn to in VK_IMAGE_LAYOUT_GENERAL or VK_IMAGE_LAYOUT_%s_ATTACHMENT_OPTIMAL",
                      role, depth ? "DEPTH_STENCIL" : "COLOR");
        return error(errc::plan_mismatch, text);
    }
    return std::nullopt;
}

result<owned<VkFramebuffer>> make_framebuffer(const device& d, const gbuffer_facts& f, const raster_targets_state& targets)
{
    std::vector<VkImageView> views;
    for (const image& each : targets.colors) {
        views.push_back(each.view);
    }
    views.push_back(targets.depth.view);
    VkFramebufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    info.renderPass = targets.pass.get();
    info.attachmentCount = static_cast<std::uint32_t>(views.size());
    info.pAttachments = views.data();
    info.width = static_cast<std::uint32_t>(f.width);
    info.height = static_cast<std::uint32_t>(f.height);
    info.layers = 1;
    return create<VkFramebuffer>(d, d.call.CreateFramebuffer, d.call.DestroyFramebuffer, info, "vkCreateFramebuffer");
}

} // namespace

result<raster_targets> rasterizer::bind(model& loaded, const gbuffer_images<image>& images)
{
    const device& d = *device_;
    const gbuffer_facts& f = loaded.state_->facts;
    std::unique_ptr<raster_targets_state> made(new (std::nothrow) raster_targets_state);
    if (!made) {
        return error(errc::out_of_memory, "out of memory");
    }
    if (const auto wrong = wrong_image(images.depth, "depth", true)) {
        return *wrong;
    }
    made->depth = images.depth;
    const std::array<const image*, target_count> given{ &images.position, &images.normal,  &images.motion,
                                                        &images.ids,      &images.surface, &images.frame };
    const auto wanted = targets_of(f);
    for (std::size_t i = 0; i < target_count; ++i) {
        if (wanted[i].wanted) {
            if (const auto wrong = wrong_image(*given[i], wanted[i].role, false)) {
                return *wrong;
            }
            made->colors.push_back(*given[i]);
        }
    }
    if (!d.host.enabled.dynamic_rendering) {
        auto pass = make_render_pass(d, f, made.get());
        if (!pass) {
            return pass.error();
        }
        made->pass = std::move(*pass);
        auto framebuffer = make_framebuffer(d, f, *made);
        if (!framebuffer) {
            return framebuffer.error();
        }
        made->framebuffer = std::move(*framebuffer);
    }
    return raster_targets(std::move(made));
}

} // namespace ao::vk
