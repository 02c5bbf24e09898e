#include "ao_vk_shaders.hpp"
#include "pipeline.hpp"
#include "support.hpp"
#include "temporal_state.hpp"

#include <cassert>
#include <cstdio>
#include <new>
#include <utility>

namespace ao::vk {

temporal_program::temporal_program(std::unique_ptr<temporal_program_state> state) : state_(std::move(state)) {}
temporal_program::temporal_program(temporal_program&&) noexcept = default;
temporal_program& temporal_program::operator=(temporal_program&&) noexcept = default;
temporal_program::~temporal_program() = default;

VkBuffer temporal_program::history(int which) const
{
    assert(which == 0 || which == 1);
    return state_->histories[static_cast<std::size_t>(which)].handle.get();
}

temporal_binding::temporal_binding(std::unique_ptr<temporal_binding_state> state) : state_(std::move(state)) {}
temporal_binding::temporal_binding(temporal_binding&&) noexcept = default;
temporal_binding& temporal_binding::operator=(temporal_binding&&) noexcept = default;
temporal_binding::~temporal_binding() = default;

temporal::temporal(std::unique_ptr<device> d) : device_(std::move(d)) {}
temporal::temporal(temporal&&) noexcept = default;
temporal& temporal::operator=(temporal&&) noexcept = default;
temporal::~temporal() = default;

result<temporal> temporal::create(const context& c)
{
    auto made = make_device(c);
    if (!made) {
        return made.error();
    }
    return temporal(std::move(*made));
}

namespace {

std::optional<error> unsupported(const device& d, const temporal_plan& p)
{
    const facts& f = p.facts.frame;
    if (const auto wrong = wrong_size(d, f.width, f.height)) {
        return wrong;
    }
    if (!can_sample(d, f.depth_format)) {
        return lacks("sample", f.depth_format);
    }
    if (f.normals != normal_source::from_depth && !can_sample(d, f.normal_format)) {
        return lacks("sample", f.normal_format);
    }
    if (p.facts.motion && !can_sample(d, p.facts.motion_format)) {
        return lacks("sample", p.facts.motion_format);
    }
    for (const pixel_format written : { f.output_format, pixel_format::r32f }) {
        if (!can_store(d, written)) {
            return lacks("store to", written);
        }
    }
    const VkPhysicalDeviceLimits& limits = d.properties.limits;
    // Every device reads 65536 texels of a buffer, the longest period.
    const std::size_t pixels = static_cast<std::size_t>(f.width) * static_cast<std::size_t>(f.height);
    if (history_bytes(p) > limits.maxStorageBufferRange || pixels > limits.maxTexelBufferElements) {
        char text[200];
        std::snprintf(text, sizeof text,
                      "a history of %dx%d takes %zu bytes, a storage buffer of the Vulkan device at most %u, and %u texels",
                      f.width, f.height, history_bytes(p), limits.maxStorageBufferRange, limits.maxTexelBufferElements);
        return error(errc::out_of_memory, text);
    }
    return std::nullopt;
}

std::optional<error> make_layouts(const device& d, temporal_program_state& made)
{
    std::array<VkDescriptorSetLayoutBinding, temporal_slot_count> bindings{};
    for (std::uint32_t i = 0; i < temporal_slot_count; ++i) {
        bindings[i] = { i, type_of(static_cast<temporal_slot>(i)), 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr };
    }
    VkDescriptorSetLayoutCreateInfo set{};
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set.bindingCount = temporal_slot_count;
    set.pBindings = bindings.data();
    AO_VK_CREATE(made.set_layout, d, DescriptorSetLayout, set);

    static_assert(sizeof(linearize_constants) <= sizeof(temporal_filter_constants));
    const VkPushConstantRange range{ VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(temporal_filter_constants) };
    const VkDescriptorSetLayout set_layout = made.set_layout.get();
    VkPipelineLayoutCreateInfo layout{};
    layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout.setLayoutCount = 1;
    layout.pSetLayouts = &set_layout;
    layout.pushConstantRangeCount = 1;
    layout.pPushConstantRanges = &range;
    AO_VK_CREATE(made.layout, d, PipelineLayout, layout);
    return std::nullopt;
}

std::optional<error> make_texels(const device& d, const buffer& from, VkFormat format, VkDeviceSize offset, VkDeviceSize size,
                                 owned<VkBufferView>& made)
{
    VkBufferViewCreateInfo view{};
    view.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
    view.buffer = from.handle.get();
    view.format = format;
    view.offset = offset;
    view.range = size;
    AO_VK_CREATE(made, d, BufferView, view);
    return std::nullopt;
}

std::optional<error> make_tables(const device& d, const temporal_plan& p, temporal_program_state& made)
{
    const auto tile = make_tile(p.settings);
    const std::vector<glm::vec4> taps = make_temporal_taps(p.settings);
    // A multiple of every offset alignment that Vulkan allows.
    static_assert(sizeof(tile) % 256 == 0);
    auto tables = make_buffer(d, sizeof(tile) + taps.size() * sizeof(glm::vec4), VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    if (!tables) {
        return tables.error();
    }
    made.tables = std::move(*tables);
    if (const auto wrong = write(d, made.tables, 0, std::as_bytes(std::span(tile)))) {
        return wrong;
    }
    if (const auto wrong = write(d, made.tables, sizeof(tile), std::as_bytes(std::span(taps)))) {
        return wrong;
    }
    if (const auto wrong = make_texels(d, made.tables, VK_FORMAT_R32G32_SFLOAT, 0, sizeof(tile), made.rotations)) {
        return wrong;
    }
    return make_texels(d, made.tables, VK_FORMAT_R32G32B32A32_SFLOAT, sizeof(tile), VK_WHOLE_SIZE, made.taps);
}

std::optional<error> make_memory(const device& d, const temporal_plan& p, temporal_program_state& made)
{
    constexpr VkBufferUsageFlags copied = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    const bool precise = p.settings.format == history_format::precise;
    for (std::size_t i = 0; i < 2; ++i) {
        auto own = make_buffer(d, history_bytes(p),
                               VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | copied, 0);
        if (!own) {
            return own.error();
        }
        made.histories[i] = std::move(*own);
        if (const auto wrong = make_texels(d, made.histories[i], precise ? VK_FORMAT_R32G32B32A32_UINT : VK_FORMAT_R32G32_UINT, 0,
                                           VK_WHOLE_SIZE, made.history_texels[i])) {
            return wrong;
        }
    }
    auto constants =
        make_buffer(d, sizeof(temporal_constants), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, 0);
    if (!constants) {
        return constants.error();
    }
    made.constants = std::move(*constants);

    const auto groups = [](int pixels, std::uint32_t size) { return (static_cast<VkDeviceSize>(pixels) + size - 1) / size; };
    const VkDeviceSize tiles = groups(p.facts.frame.width, d.host.group.x) * groups(p.facts.frame.height, d.host.group.y);
    auto listed = make_buffer(
        d, 16 + 8 * tiles,
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, 0);
    if (!listed) {
        return listed.error();
    }
    made.tiles = std::move(*listed);

    picture_shape shape;
    shape.format = VK_FORMAT_R32_SFLOAT;
    shape.width = static_cast<std::uint32_t>(p.facts.frame.width);
    shape.height = static_cast<std::uint32_t>(p.facts.frame.height);
    shape.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    const auto add = [&](picture& to) -> std::optional<error> {
        auto own = make_picture(d, shape);
        if (!own) {
            return own.error();
        }
        to = std::move(*own);
        return std::nullopt;
    };
    if (p.linearize || made.copies_depth) {
        if (const auto wrong = add(made.eye_depth)) {
            return wrong;
        }
    }
    for (const temporal_step& step : p.steps) {
        if (step.type == temporal_pass_type::filter_rows) {
            return add(made.rows);
        }
    }
    return std::nullopt;
}

std::span<const std::uint32_t> shader_of(const device& d, temporal_pass_type type, bool r8)
{
    using namespace shaders;
    const bool software = is_software(d);
    switch (type) {
    case temporal_pass_type::linearize:
        return linearize_comp;
    case temporal_pass_type::accumulate:
        return software ? temporal_accumulate_comp_software : temporal_accumulate_comp;
    case temporal_pass_type::filter_rows:
        return software ? temporal_rows_comp_software : temporal_rows_comp;
    case temporal_pass_type::filter_columns:
        return software ? (r8 ? temporal_columns_comp_software_r8 : temporal_columns_comp_software)
                        : (r8 ? temporal_columns_comp_r8 : temporal_columns_comp);
    case temporal_pass_type::resolve:
        return r8 ? temporal_resolve_comp_r8 : temporal_resolve_comp;
    }
    return {};
}

result<owned<VkPipeline>> make_linearize(const device& d, bool affine, bool positions, VkPipelineLayout layout)
{
    // Of shaders/resources.glsl.
    const std::array<specialisation_value, 4> values{
        { { 0, affine }, { 8, positions }, { 10, d.host.group.x }, { 11, d.host.group.y } }
    };
    return make_compute_pipeline(d, shaders::linearize_comp, values, layout);
}

result<owned<VkPipeline>> make_pipeline(const device& d, const temporal_plan& p, const temporal_step& step,
                                        VkPipelineLayout layout)
{
    const temporal_options& o = step.options;
    if (step.type == temporal_pass_type::linearize) {
        return make_linearize(d, o.affine, p.facts.frame.depth == depth_source::position, layout);
    }
    const std::array<specialisation_value, 15> values{ { { 0, static_cast<std::uint32_t>(o.most_samples) },
                                                         { 1, static_cast<std::uint32_t>(o.contribution) },
                                                         { 2, static_cast<std::uint32_t>(o.history_format) },
                                                         { 3, static_cast<std::uint32_t>(o.invalidation) },
                                                         { 4, o.reproject },
                                                         { 5, o.use_motion },
                                                         { 6, o.cubic },
                                                         { 7, static_cast<std::uint32_t>(o.normal_source) },
                                                         { 8, o.rotate_normals },
                                                         { 9, o.parallel },
                                                         { 10, o.limit_thickness },
                                                         { 11, static_cast<std::uint32_t>(o.filter_radius) },
                                                         { 13, static_cast<std::uint32_t>(o.slice_taps) },
                                                         { 14, d.host.group.x },
                                                         { 15, d.host.group.y } } };
    return make_compute_pipeline(d, shader_of(d, step.type, p.facts.frame.output_format == pixel_format::r8), values, layout);
}

std::optional<error> make_pipelines(const device& d, const temporal_plan& p, temporal_program_state& made)
{
    for (std::size_t i = 0; i < p.steps.size(); ++i) {
        auto pipeline = make_pipeline(d, p, p.steps[i], made.layout.get());
        if (!pipeline) {
            return pipeline.error();
        }
        made.pipelines[i] = std::move(*pipeline);
    }
    if (made.copies_depth) {
        auto pipeline = make_linearize(d, true, false, made.layout.get());
        if (!pipeline) {
            return pipeline.error();
        }
        made.copy = std::move(*pipeline);
    }
    return std::nullopt;
}

} // namespace

result<temporal_program> temporal::prepare_temporal(const temporal_plan& p)
{
    const device& d = *device_;
    if (const auto wrong = unsupported(d, p)) {
        return *wrong;
    }
    std::unique_ptr<temporal_program_state> made(new (std::nothrow) temporal_program_state);
    if (!made) {
        return error(errc::out_of_memory, "out of memory");
    }
    made->plan = p;
    made->copies_depth = is_software(d) && !p.linearize;
    for (const auto make : { make_tables, make_memory }) {
        if (const auto wrong = make(d, p, *made)) {
            return *wrong;
        }
    }
    if (const auto wrong = make_layouts(d, *made)) {
        return *wrong;
    }
    if (const auto wrong = make_pipelines(d, p, *made)) {
        return *wrong;
    }
    return temporal_program(std::move(made));
}

} // namespace ao::vk
