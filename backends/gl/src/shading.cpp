#include "ao/gl/shading.hpp"

#include "ao_gl_shaders.hpp"
#include "buffer.hpp"
#include "compile.hpp"
#include "host_texture.hpp"
#include "limits.hpp"
#include "saved_state.hpp"
#include "state.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <string>
#include <utility>

namespace ao::gl {

namespace {

constexpr std::size_t input_count = 6; // texture units, in the order of shaders/shading.glsl
constexpr GLuint table_index = 0;
constexpr GLuint heap_index = 1;
constexpr GLuint statistics_index = 2;
constexpr GLuint color_unit = 0;
constexpr GLuint targets_unit = 1;

struct constant_block {
    shade_constants constants;
    GLint output;
    std::array<GLint, 3> reserved;
};
static_assert(sizeof(constant_block) <= constants_stride);

constexpr std::array<GLuint, 13> constant_ids{ 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12 };

} // namespace

struct shade_program_state {
    object shade;
    object segment; // where the plan has any
    object constants;
    object table;
    object heap;
    object statistics;
    object targets;
    object sampler;
    shade_options options;
    pixel_format visibility{};
    int width = 0;
    int height = 0;
    int target_count = 0;
    std::size_t passes = 0;
    std::size_t words = 0;
};

struct shade_binding_state {
    std::array<object, input_count> views;
    std::array<GLuint, input_count> inputs{};
    GLuint color = 0;
};

shade_program::shade_program(std::unique_ptr<shade_program_state> state) : state_(std::move(state)) {}
shade_program::shade_program(shade_program&&) noexcept = default;
shade_program& shade_program::operator=(shade_program&&) noexcept = default;
shade_program::~shade_program() = default;

shade_binding::shade_binding(std::unique_ptr<shade_binding_state> state) : state_(std::move(state)) {}
shade_binding::shade_binding(shade_binding&&) noexcept = default;
shade_binding& shade_binding::operator=(shade_binding&&) noexcept = default;
shade_binding::~shade_binding() = default;

shading::shading(std::unique_ptr<functions> loaded, const options& chosen) : gl_(std::move(loaded)), options_(chosen) {}
shading::shading(shading&&) noexcept = default;
shading& shading::operator=(shading&&) noexcept = default;
shading::~shading() = default;

result<shading> shading::create(std::unique_ptr<functions> loaded, options chosen)
{
    chosen.route = route::compute;
    if (const auto wrong = settle(*loaded, chosen)) {
        return *wrong;
    }
    return shading(std::move(loaded), chosen);
}

result<shading> shading::create(backend::get_proc_address loader, const options& chosen)
{
    auto loaded = std::make_unique<functions>();
    if (const auto wrong = load(*loaded, loader)) {
        return *wrong;
    }
    return create(std::move(loaded), chosen);
}

result<shading> shading::create(backend::get_proc_address_as_data loader, const options& chosen)
{
    auto loaded = std::make_unique<functions>();
    if (const auto wrong = load(*loaded, loader)) {
        return *wrong;
    }
    return create(std::move(loaded), chosen);
}

namespace {

result<object> link_shading(const functions& gl, const options& chosen, const shade_plan& p, shade_pass_type type)
{
    const shade_options& o = p.options;
    const std::array<GLuint, 13> values{ o.stored_position,
                                         o.parallel,
                                         static_cast<GLuint>(o.normal_source),
                                         o.visibility,
                                         o.maps,
                                         o.reflections,
                                         o.frames,
                                         o.blends,
                                         p.facts.visibility_format == pixel_format::r8,
                                         chosen.group_width,
                                         chosen.group_height,
                                         o.bent_normal,
                                         o.multi_bounce };
    const source from = type == shade_pass_type::shade
                            ? source{ shaders::shade_comp, shaders::shade_comp_text, constant_ids, "shading" }
                            : source{ shaders::segment_comp, shaders::segment_comp_text, constant_ids, "blending" };
    result<object> compiled = compile(gl, chosen.source, GL_COMPUTE_SHADER, from, values);
    if (!compiled) {
        return compiled.error();
    }
    return link(gl, from.name, { &*compiled, 1 });
}

result<object> make_targets(const functions& gl, const shade_plan& p)
{
    if (p.targets > gl.integer(GL_MAX_ARRAY_TEXTURE_LAYERS)) {
        return error(errc::out_of_memory, "a blend needs " + std::to_string(p.targets) + " pictures, the driver has " +
                                              std::to_string(gl.integer(GL_MAX_ARRAY_TEXTURE_LAYERS)) + " layers");
    }
    GLuint name = 0;
    gl.CreateTextures(GL_TEXTURE_2D_ARRAY, 1, &name);
    object made(gl, object_type::texture, name);
    gl.TextureStorage3D(name, 1, GL_RGBA32F, p.facts.width, p.facts.height, p.targets);
    return made;
}

} // namespace

result<shade_program> shading::prepare_shading(const shade_plan& p, const texel_heap& heap)
{
    const functions& gl = *gl_;
    gl.take_error();
    if (const auto wrong = check_size(gl, options_, p.facts.width, p.facts.height)) {
        return *wrong;
    }
    auto state = std::make_unique<shade_program_state>();
    state->options = p.options;
    state->visibility = p.facts.visibility_format;
    state->width = p.facts.width;
    state->height = p.facts.height;
    state->target_count = p.targets;
    state->passes = p.passes.size();
    state->words = p.words.size();

    buffer_maker buffers(gl);
    state->table =
        buffers.storage("the table of materials and blends", std::as_bytes(std::span(p.words)), GL_DYNAMIC_STORAGE_BIT);
    const bool reads_heap = p.options.maps || p.options.reflections;
    state->heap = buffers.storage("the heap of textures",
                                  reads_heap ? std::as_bytes(std::span(heap.words)) : std::span<const std::byte>{}, 0);
    const std::array<GLuint, 1> zero{};
    state->statistics = buffers.storage("a counter", std::as_bytes(std::span(zero)), GL_DYNAMIC_STORAGE_BIT);
    state->constants = make_object(gl, object_type::buffer, gl.CreateBuffers);
    gl.NamedBufferStorage(state->constants.name(), constants_stride * static_cast<GLsizeiptr>(p.passes.size()), nullptr,
                          GL_DYNAMIC_STORAGE_BIT);
    if (buffers.failed()) {
        return *buffers.failed();
    }
    if (p.targets != 0) {
        result<object> targets = make_targets(gl, p);
        if (!targets) {
            return targets.error();
        }
        state->targets = std::move(*targets);
    }
    if (const GLenum code = gl.take_error(); code != GL_NO_ERROR) {
        return gl_error("allocating the pictures of the blends", code);
    }
    state->sampler = make_sampler(gl);
    for (const shade_pass& each : p.passes) {
        object& program = each.type == shade_pass_type::shade ? state->shade : state->segment;
        if (program.name() == 0) {
            result<object> linked = link_shading(gl, options_, p, each.type);
            if (!linked) {
                return linked.error();
            }
            program = std::move(*linked);
        }
    }
    if (const GLenum code = gl.take_error(); code != GL_NO_ERROR) {
        return gl_error("preparing the shading", code);
    }
    return shade_program(std::move(state));
}

std::optional<error> shading::update_table(shade_program& program, const shade_plan& p)
{
    const shade_program_state& state = *program.state_;
    if (p.words.size() != state.words) {
        return error(errc::plan_mismatch, "the table has another size than the prepared one");
    }
    gl_->NamedBufferSubData(state.table.name(), 0, static_cast<GLsizeiptr>(state.words * sizeof(GLuint)), p.words.data());
    return std::nullopt;
}

result<shade_binding> shading::bind_shading(shade_program& program, const shade_plan& p, const shade_images<image>& images)
{
    const functions& gl = *gl_;
    gl.take_error();
    const shade_program_state& from = *program.state_;
    const shade_facts& f = p.facts;
    if (from.options != p.options || from.visibility != f.visibility_format || from.width != f.width || from.height != f.height ||
        from.passes != p.passes.size() || from.target_count != p.targets) {
        return error(errc::plan_mismatch, "the program was prepared for another plan");
    }
    struct input {
        GLuint texture;
        const char* role;
        pixel_format format;
        bool wanted;
    };
    const shade_options& o = p.options;
    const std::array<input, input_count> inputs{ {
        f.stored_position ? input{ images.position, "position", f.position_format, true }
                          : input{ images.depth, "depth", f.depth_format, true },
        { images.normal, "normal", f.normal_format, true },
        { images.ids, "ids", pixel_format::rg32ui, true },
        { images.surface, "surface", pixel_format::rgba32f, o.maps || o.frames },
        { images.frame, "frame", pixel_format::rgba32f, o.frames },
        { images.visibility, "visibility", f.visibility_format, o.visibility },
    } };
    auto state = std::make_unique<shade_binding_state>();
    for (std::size_t i = 0; i < input_count; ++i) {
        const input& each = inputs[i];
        if (!each.wanted) {
            // Not read; name 0 would unbind textures of other targets too.
            state->inputs[i] = state->inputs[0];
            continue;
        }
        if (const auto wrong = check_texture(gl, each.texture, each.role, each.format, f.width, f.height)) {
            return *wrong;
        }
        const result<GLuint> readable = make_readable(gl, each.texture, each.role, each.format, state->views[i]);
        if (!readable) {
            return readable.error();
        }
        state->inputs[i] = *readable;
    }
    if (const auto wrong = check_texture(gl, images.color, "color", pixel_format::rgba32f, f.width, f.height)) {
        return *wrong;
    }
    state->color = images.color;
    if (const GLenum code = gl.take_error(); code != GL_NO_ERROR) {
        return gl_error("binding the textures", code);
    }
    return shade_binding(std::move(state));
}

void shading::record_shading(commands, shade_program& program, shade_binding& bound, const shade_plan& p, std::size_t index)
{
    const functions& gl = *gl_;
    const shade_program_state& state = *program.state_;
    assert(index < p.passes.size() && p.passes.size() == state.passes);
    const shade_pass& each = p.passes[index];

    std::optional<saved_state> before;
    if (options_.restore_state) {
        before.emplace(gl, touched{ .textures = input_count, .uniform_buffers = 1, .storage_buffers = 3, .images = 2 });
    }
    const GLintptr offset = constants_stride * static_cast<GLintptr>(index);
    const constant_block block{ each.constants, each.output, {} };
    gl.NamedBufferSubData(state.constants.name(), offset, sizeof block, &block);

    gl.UseProgram(each.type == shade_pass_type::shade ? state.shade.name() : state.segment.name());
    std::array<GLuint, input_count> samplers{};
    samplers.fill(state.sampler.name());
    gl.BindTextures(0, input_count, bound.state_->inputs.data());
    gl.BindSamplers(0, input_count, samplers.data());
    gl.BindBufferRange(GL_UNIFORM_BUFFER, constants_index, state.constants.name(), offset, sizeof block);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, table_index, state.table.name());
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, heap_index, state.heap.name());
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, statistics_index, state.statistics.name());
    gl.BindImageTexture(color_unit, bound.state_->color, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
    if (state.target_count != 0) {
        gl.BindImageTexture(targets_unit, state.targets.name(), 0, GL_TRUE, 0, GL_READ_WRITE, GL_RGBA32F);
    }
    const auto groups = [](int pixels, unsigned size) { return (static_cast<GLuint>(pixels) + size - 1) / size; };
    gl.MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    gl.DispatchCompute(groups(state.width, options_.group_width), groups(state.height, options_.group_height), 1);
    if (index + 1 == state.passes) {
        gl.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT |
                         GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    }
}

result<std::uint64_t> shading::clamped_weights(shade_program& program)
{
    GLuint count = 0;
    gl_->GetNamedBufferSubData(program.state_->statistics.name(), 0, sizeof count, &count);
    return std::uint64_t{ count };
}

} // namespace ao::gl
