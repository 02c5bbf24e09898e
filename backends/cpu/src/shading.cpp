#include "ao/cpu/shading.hpp"

#include "resources.hpp"
#include "threads.hpp"
#include "views.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cstring>
#include <new>
#include <stdexcept>
#include <utility>
#include <vector>

namespace ao::cpu {

struct shade_program_state {
    std::vector<std::uint32_t> table;
    std::vector<std::uint32_t> heap;
    std::vector<glm::vec4> targets; // picture by picture
    std::atomic<std::uint64_t> clamped = 0;
    shade_options options;
    int width = 0;
    int height = 0;
    int target_count = 0;
    std::size_t passes = 0;

    std::size_t place(int target, glm::ivec2 pixel) const
    {
        return (static_cast<std::size_t>(target) * static_cast<std::size_t>(height) + static_cast<std::size_t>(pixel.y)) *
                   static_cast<std::size_t>(width) +
               static_cast<std::size_t>(pixel.x);
    }
};

shade_program::shade_program(std::unique_ptr<shade_program_state> state) : state_(std::move(state)) {}
shade_program::shade_program(shade_program&&) noexcept = default;
shade_program& shade_program::operator=(shade_program&&) noexcept = default;
shade_program::~shade_program() = default;

shading::shading(std::unique_ptr<detail::threads> workers) : workers_(std::move(workers)) {}
shading::shading(shading&&) noexcept = default;
shading& shading::operator=(shading&&) noexcept = default;
shading::~shading() = default;

result<shading> shading::create(const options& o)
{
    auto workers = detail::make_threads(o);
    if (!workers) {
        return workers.error();
    }
    return shading(std::move(*workers));
}

namespace {

using pixel_reader = detail::reader<float>;

pixel_reader read(const image_view& v)
{
    return pixel_reader({ static_cast<std::byte*>(v.data), v.row_bytes, bytes_per_pixel(v.format) / 4, v.format });
}

// Answers to the callbacks of shade_pass.h.
struct shade_resources {
    shade_program_state* program;
    image_view visibility_view;
    pixel_reader geometry_reader;
    pixel_reader normal_reader;
    pixel_reader ids_reader;
    pixel_reader surface_reader;
    pixel_reader frame_reader;
    bool stored_position;
    std::uint64_t clamped = 0;

    glm::vec4 geometry(glm::ivec2 p) const
    {
        if (stored_position) {
            return geometry_reader.normal(p); // float formats of positions are those of normals
        }
        return { geometry_reader.format == pixel_format::d24 ? geometry_reader.depth24(p) : geometry_reader.loaded(p), 0, 0, 0 };
    }
    glm::vec4 normal(glm::ivec2 p) const { return normal_reader.normal(p); }
    glm::vec4 surface(glm::ivec2 p) const { return four(surface_reader, p); }
    glm::vec4 frame(glm::ivec2 p) const { return four(frame_reader, p); }
    glm::uvec2 ids(glm::ivec2 p) const { return glm::uvec2(ids_reader.word(p, 0), ids_reader.word(p, 1)); }
    float visibility(glm::ivec2 p) const
    {
        const std::byte* texel = detail::texel_at(visibility_view, p.x, p.y);
        if (visibility_view.format == pixel_format::r8) {
            return static_cast<float>(std::to_integer<int>(*texel)) / 255.0F;
        }
        if (visibility_view.format == pixel_format::rgba16f) {
            return half_at(texel, 0);
        }
        float stored = 0;
        std::memcpy(&stored, texel, sizeof stored);
        return stored;
    }
    glm::vec3 bent_normal(glm::ivec2 p) const
    {
        const std::byte* texel = detail::texel_at(visibility_view, p.x, p.y);
        return { half_at(texel, 1), half_at(texel, 2), half_at(texel, 3) };
    }
    glm::vec4 target(int i, glm::ivec2 p) const { return program->targets[program->place(i, p)]; }
    std::uint32_t word(std::uint32_t i) const { return program->table[i]; }
    std::uint32_t texel(std::uint32_t i) const { return program->heap[i]; }
    void count_clamped(std::uint32_t n) { clamped += n; }

private:
    static float half_at(const std::byte* texel, std::size_t i)
    {
        std::uint16_t code = 0;
        std::memcpy(&code, texel + 2 * i, sizeof code);
        return half_to_float(code);
    }
    static glm::vec4 four(const pixel_reader& from, glm::ivec2 p)
    {
        return { from.component(p, 0), from.component(p, 1), from.component(p, 2), from.component(p, 3) };
    }
};

} // namespace

result<shade_program> shading::prepare_shading(const shade_plan& p, const texel_heap& heap)
{
    try {
        auto state = std::make_unique<shade_program_state>();
        state->table = p.words;
        if (p.options.maps || p.options.reflections) {
            state->heap = heap.words;
        }
        state->options = p.options;
        state->width = p.facts.width;
        state->height = p.facts.height;
        state->target_count = p.targets;
        state->passes = p.passes.size();
        state->targets.resize(state->place(p.targets, { 0, 0 }));
        return shade_program(std::move(state));
    } catch (const std::bad_alloc&) {
        return error(errc::out_of_memory, "no memory for the table, the textures and the pictures of the blends");
    } catch (const std::length_error&) {
        return error(errc::out_of_memory, "the pictures of the blends are larger than any memory");
    }
}

std::optional<error> shading::update_table(shade_program& program, const shade_plan& p)
{
    std::vector<std::uint32_t>& table = program.state_->table;
    if (p.words.size() != table.size()) {
        return error(errc::plan_mismatch, "the table has another size than the one prepared");
    }
    std::copy(p.words.begin(), p.words.end(), table.begin());
    return std::nullopt;
}

result<shade_binding> shading::bind_shading(shade_program& program, const shade_plan& p, const shade_images<image>& images)
{
    const shade_program_state& state = *program.state_;
    const shade_facts& f = p.facts;
    const shade_options& o = state.options;
    if (p.options != o || f.width != state.width || f.height != state.height || p.targets != state.target_count ||
        p.passes.size() != state.passes) {
        return error(errc::plan_mismatch, "the plan differs from the one prepared");
    }
    struct expected {
        const image_view& view;
        const char* name;
        pixel_format format;
        bool wanted;
    };
    const expected all[] = {
        { images.depth, "depth", f.depth_format, !f.stored_position },
        { images.position, "position", f.position_format, f.stored_position },
        { images.normal, "normal", f.normal_format, true },
        { images.ids, "ids", pixel_format::rg32ui, true },
        { images.surface, "surface", pixel_format::rgba32f, o.maps || o.frames },
        { images.frame, "frame", pixel_format::rgba32f, o.frames },
        { images.visibility, "visibility", f.visibility_format, f.visibility },
        { images.color, "color", pixel_format::rgba32f, true },
    };
    for (const expected& each : all) {
        if (each.wanted) {
            if (const auto wrong = detail::unfit(each.view, f.width, f.height, each.format, each.name)) {
                return *wrong;
            }
        }
    }
    return shade_binding(images);
}

void shading::record_shading(commands, shade_program& program, shade_binding& bound, const shade_plan& p, std::size_t index)
{
    shade_program_state& state = *program.state_;
    const shade_pass& pass = p.passes[index];
    const shade_images<image_view>& images = bound.images_;
    const shade_options& o = state.options;
    const shade_resources resources{ &state,
                                     images.visibility,
                                     read(o.stored_position ? images.position : images.depth),
                                     read(images.normal),
                                     read(images.ids),
                                     read(images.surface),
                                     read(images.frame),
                                     o.stored_position };
    using body_type = shading_pass<float, shade_resources>;
    const auto c = std::bit_cast<body_type::ao_shade_constants>(pass.constants);
    const auto store = [&](int output, glm::ivec2 pixel, const glm::vec4& color) {
        if (output == blend_result) {
            std::memcpy(detail::texel_at(images.color, pixel.x, pixel.y), &color, sizeof color);
        }
        else {
            state.targets[state.place(output, pixel)] = color;
        }
    };
    workers_->over_tiles(state.width, state.height, [&](const detail::tile& t) {
        body_type body{ resources,     o.stored_position, o.parallel, o.normal_source, o.visibility,  o.maps,
                        o.reflections, o.frames,          o.blends,   o.bent_normal,   o.multi_bounce };
        for (int y = t.top; y < t.bottom; ++y) {
            for (int x = t.left; x < t.right; ++x) {
                const glm::ivec2 pixel(x, y);
                if (pass.type == shade_pass_type::shade) {
                    store(blend_result, pixel, body.ao_shade_pass(c, pixel));
                    continue;
                }
                const glm::vec4 color = body.ao_segment_pass(c, pixel);
                if (color.w >= 0) {
                    store(pass.output, pixel, color);
                }
            }
        }
        if (body.resources.clamped != 0) {
            state.clamped.fetch_add(body.resources.clamped, std::memory_order_relaxed);
        }
    });
}

result<std::uint64_t> shading::clamped_weights(shade_program& program)
{
    return program.state_->clamped.load();
}

} // namespace ao::cpu
