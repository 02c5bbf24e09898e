#include "ao_vk_shaders.hpp"
#include "pipeline.hpp"
#include "raster_state.hpp"
#include "shader_outputs.hpp"
#include "support.hpp"

#include <algorithm>

namespace ao::vk {

namespace {

struct fixed_state {
    bool cull_back;
    bool clockwise;
    bool reversed;
};

class pipeline_maker {
public:
    static result<pipeline_maker> create(const device& d, const gbuffer_facts& f, const raster_model_state& made)
    {
        pipeline_maker maker(d, f, made);
        const auto load = [&](owned<VkShaderModule>& to, std::span<const std::uint32_t> code) {
            auto module = make_module(d, code);
            if (module) {
                to = std::move(*module);
            }
            return module ? std::nullopt : std::optional(module.error());
        };
        if (const auto wrong = load(maker.vertex_, shaders::geometry_vert)) {
            return *wrong;
        }
        std::uint32_t kept = 0;
        const auto targets = targets_of(f);
        for (std::size_t i = 0; i < target_count; ++i) {
            kept |= targets[i].wanted ? 1U << i : 0U;
        }
        if (const auto wrong = load(maker.fragment_, with_outputs(shaders::geometry_frag, kept))) {
            return *wrong;
        }
        if (const auto wrong = load(maker.hardware_fragment_, with_outputs(shaders::geometry_frag_hardware, kept))) {
            return *wrong;
        }
        return maker;
    }

    result<owned<VkPipeline>> make(const geometry_options& n, const fixed_state& fixed) const
    {
        std::array<specialisation_value, 12> values{};
        for (std::uint32_t i = 0; i < values.size(); ++i) {
            values[i] = { i, n[i] };
        }
        const specialisation constants(values);
        std::array<VkPipelineShaderStageCreateInfo, 2> stages{};
        for (VkPipelineShaderStageCreateInfo& stage : stages) {
            stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
            stage.pName = "main";
            stage.pSpecializationInfo = constants.info();
        }
        stages[0].stage = VK_SHADER_STAGE_VERTEX_BIT;
        stages[0].module = vertex_.get();
        stages[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
        stages[1].module = n.back() != 0 ? hardware_fragment_.get() : fragment_.get();

        // Attributes that a variant does not read stand still at the first vertex of another.
        std::array<VkVertexInputBindingDescription, vertex_attribute_count> bindings{};
        std::array<VkVertexInputAttributeDescription, vertex_attribute_count> attributes{};
        for (std::uint32_t i = 0; i < vertex_attribute_count; ++i) {
            constexpr std::array<VkFormat, 5> formats{ VK_FORMAT_UNDEFINED, VK_FORMAT_R32_SFLOAT, VK_FORMAT_R32G32_SFLOAT,
                                                       VK_FORMAT_R32G32B32_SFLOAT, VK_FORMAT_R32G32B32A32_SFLOAT };
            const auto floats = static_cast<std::uint32_t>(vertex_attribute_floats[i]);
            const bool there = made_->attributes[i].handle.get() != VK_NULL_HANDLE;
            bindings[i] = { i, there ? 4 * floats : 0, VK_VERTEX_INPUT_RATE_VERTEX };
            attributes[i] = { i, i, formats[floats], 0 };
        }
        VkPipelineVertexInputStateCreateInfo input{};
        input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
        input.vertexBindingDescriptionCount = vertex_attribute_count;
        input.pVertexBindingDescriptions = bindings.data();
        input.vertexAttributeDescriptionCount = vertex_attribute_count;
        input.pVertexAttributeDescriptions = attributes.data();
        return make(stages, input, fixed);
    }

private:
    pipeline_maker(const device& d, const gbuffer_facts& f, const raster_model_state& made) : d_(&d), facts_(f), made_(&made) {}

    result<owned<VkPipeline>> make(std::span<const VkPipelineShaderStageCreateInfo> stages,
                                   const VkPipelineVertexInputStateCreateInfo& input, const fixed_state& fixed) const
    {
        VkPipelineInputAssemblyStateCreateInfo assembly{};
        assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
        assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
        const VkExtent2D size{ static_cast<std::uint32_t>(facts_.width), static_cast<std::uint32_t>(facts_.height) };
        const VkViewport whole{ 0, 0, static_cast<float>(size.width), static_cast<float>(size.height), 0, 1 };
        const VkRect2D scissor{ { 0, 0 }, size };
        VkPipelineViewportStateCreateInfo viewport{};
        viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
        viewport.viewportCount = 1;
        viewport.pViewports = &whole;
        viewport.scissorCount = 1;
        viewport.pScissors = &scissor;
        VkPipelineRasterizationStateCreateInfo raster{};
        raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
        raster.polygonMode = VK_POLYGON_MODE_FILL;
        raster.cullMode = fixed.cull_back ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_NONE;
        raster.frontFace = fixed.clockwise ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE;
        raster.lineWidth = 1;
        VkPipelineMultisampleStateCreateInfo samples{};
        samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
        samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
        VkPipelineDepthStencilStateCreateInfo depth{};
        depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
        depth.depthTestEnable = VK_TRUE;
        depth.depthWriteEnable = VK_TRUE;
        depth.depthCompareOp = fixed.reversed ? VK_COMPARE_OP_GREATER : VK_COMPARE_OP_LESS;
        const std::vector<VkFormat> formats = color_formats(facts_);
        std::vector<VkPipelineColorBlendAttachmentState> targets(formats.size());
        for (VkPipelineColorBlendAttachmentState& target : targets) {
            target.colorWriteMask =
                VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
        }
        VkPipelineColorBlendStateCreateInfo blend{};
        blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
        blend.attachmentCount = static_cast<std::uint32_t>(formats.size());
        blend.pAttachments = targets.data();
        constexpr std::array<VkDynamicState, 3> states{ VK_DYNAMIC_STATE_CULL_MODE, VK_DYNAMIC_STATE_FRONT_FACE,
                                                        VK_DYNAMIC_STATE_DEPTH_COMPARE_OP };
        VkPipelineDynamicStateCreateInfo dynamic{};
        dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
        dynamic.dynamicStateCount = static_cast<std::uint32_t>(states.size());
        dynamic.pDynamicStates = states.data();
        VkPipelineRenderingCreateInfo rendering{};
        rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
        rendering.colorAttachmentCount = static_cast<std::uint32_t>(formats.size());
        rendering.pColorAttachmentFormats = formats.data();
        rendering.depthAttachmentFormat = native_format(facts_.depth_format);

        const enabled_features& enabled = d_->host.enabled;
        VkGraphicsPipelineCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
        info.pNext = enabled.dynamic_rendering ? &rendering : nullptr;
        info.stageCount = static_cast<std::uint32_t>(stages.size());
        info.pStages = stages.data();
        info.pVertexInputState = &input;
        info.pInputAssemblyState = &assembly;
        info.pViewportState = &viewport;
        info.pRasterizationState = &raster;
        info.pMultisampleState = &samples;
        info.pDepthStencilState = &depth;
        info.pColorBlendState = &blend;
        info.pDynamicState = enabled.extended_dynamic_state ? &dynamic : nullptr;
        info.layout = made_->layout.get();
        info.renderPass = made_->pass.get();
        VkPipeline pipeline = VK_NULL_HANDLE;
        const VkResult code =
            d_->call.CreateGraphicsPipelines(d_->host.device, d_->host.pipeline_cache, 1, &info, nullptr, &pipeline);
        if (code != VK_SUCCESS) {
            return api_error(code, "vkCreateGraphicsPipelines");
        }
        return owned<VkPipeline>(d_->host.device, pipeline, d_->call.DestroyPipeline);
    }

    const device* d_;
    gbuffer_facts facts_;
    const raster_model_state* made_;
    owned<VkShaderModule> vertex_;
    owned<VkShaderModule> fragment_;
    owned<VkShaderModule> hardware_fragment_;
};

} // namespace

std::optional<error> make_pipelines(const device& d, sampling how, const draw_plan& p, raster_model_state& into)
{
    if (const auto wrong = make_layouts(d, how == sampling::hardware, into)) {
        return wrong;
    }
    if (!d.host.enabled.dynamic_rendering) {
        auto pass = make_render_pass(d, p.facts, nullptr);
        if (!pass) {
            return pass.error();
        }
        into.pass = std::move(*pass);
    }
    auto maker = pipeline_maker::create(d, p.facts, into);
    if (!maker) {
        return maker.error();
    }
    struct family {
        geometry_options of;
        bool cull_back;
        std::size_t first;
    };
    const bool dynamic = d.host.enabled.extended_dynamic_state;
    std::vector<family> made;
    for (const draw_variant& v : p.variants) {
        const geometry_options n = make_geometry_options(v, p.facts, how == sampling::hardware);
        const bool another = std::none_of(made.begin(), made.end(), [&](const family& f) { return f.of == n; });
        into.programs += another ? 1 : 0;
        const bool cull = !dynamic && v.cull_back;
        const auto same =
            std::find_if(made.begin(), made.end(), [&](const family& f) { return f.of == n && f.cull_back == cull; });
        if (same != made.end()) {
            into.first_pipeline.push_back(same->first);
            continue;
        }
        into.first_pipeline.push_back(into.pipelines.size());
        made.push_back({ n, cull, into.pipelines.size() });
        for (std::size_t state = 0; state < (dynamic ? 1U : 4U); ++state) {
            auto pipeline =
                maker->make(n, { cull, (state & pipeline_state(true, false)) != 0, (state & pipeline_state(false, true)) != 0 });
            if (!pipeline) {
                return pipeline.error();
            }
            into.pipelines.push_back(std::move(*pipeline));
        }
    }
    return std::nullopt;
}

} // namespace ao::vk
