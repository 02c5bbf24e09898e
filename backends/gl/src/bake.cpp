#include "ao/gl/bake.hpp"

#include "ao_gl_shaders.hpp"
#include "bake_state.hpp"
#include "compile.hpp"
#include "limits.hpp"

#include <algorithm>
#include <utility>

namespace ao::gl {

baker::baker(std::unique_ptr<bake_state> state) : state_(std::move(state)) {}
baker::baker(baker&&) noexcept = default;
baker& baker::operator=(baker&&) noexcept = default;
baker::~baker() = default;

const options& baker::chosen() const
{
    return state_->chosen;
}

namespace {

constexpr unsigned most_invocations = 256; // whose tile every driver holds

constexpr std::array<GLuint, detail::bake_gpu_constants> constant_ids{ 0, 1, 2, 3, 4, 5, 6, 7 };

source source_of(detail::bake_shader shader)
{
    using namespace shaders;
    switch (shader) {
    case detail::bake_shader::brute:
        return { bake_brute_comp, bake_brute_comp_text, constant_ids, "bake, brute" };
    case detail::bake_shader::tiled:
        return { bake_tiled_comp, bake_tiled_comp_text, constant_ids, "bake, tiled" };
    case detail::bake_shader::hierarchy:
        return { bake_hierarchy_comp, bake_hierarchy_comp_text, constant_ids, "bake, hierarchy" };
    case detail::bake_shader::project:
        return { bake_project_comp, bake_project_comp_text, constant_ids, "bake, projection" };
    case detail::bake_shader::packed:
        return { bake_packed_comp, bake_packed_comp_text, constant_ids, "bake, packed" };
    case detail::bake_shader::raster_sort:
        return { bake_raster_sort_comp, bake_raster_sort_comp_text, constant_ids, "bake, sorting" };
    case detail::bake_shader::raster_cover:
        return { bake_raster_cover_comp, bake_raster_cover_comp_text, constant_ids, "bake, raster" };
    case detail::bake_shader::cube_clear:
        return { bake_cube_clear_comp, bake_cube_clear_comp_text, constant_ids, "bake, clearing of cube maps" };
    case detail::bake_shader::cube_depth:
        return { bake_cube_depth_comp, bake_cube_depth_comp_text, constant_ids, "bake, cube maps" };
    case detail::bake_shader::cube_count:
        return { bake_cube_count_comp, bake_cube_count_comp_text, constant_ids, "bake, sums of cube maps" };
    case detail::bake_shader::count_packed:
        break;
    }
    return { bake_count_packed_comp, bake_count_packed_comp_text, constant_ids, "bake, sums" };
}

} // namespace

result<GLuint> bake_program_of(bake_state& state, detail::bake_shader shader,
                               const std::array<std::uint32_t, detail::bake_gpu_constants>& constants)
{
    for (const bake_program& each : state.programs) {
        if (each.shader == shader && each.constants == constants) {
            return each.program.name();
        }
    }
    const functions& gl = *state.gl;
    const source from = source_of(shader);
    const std::array<GLuint, detail::bake_gpu_constants> values = constants;
    result<object> compiled = compile(gl, state.chosen.source, GL_COMPUTE_SHADER, from, values);
    if (!compiled) {
        return compiled.error();
    }
    result<object> linked = link(gl, from.name, { &*compiled, 1 });
    if (!linked) {
        return linked.error();
    }
    state.programs.push_back({ shader, constants, std::move(*linked) });
    return state.programs.back().program.name();
}

result<baker> baker::create(std::unique_ptr<functions> loaded, options chosen, const bake_gpu_options& cut)
{
    chosen.route = route::compute;
    if (const auto wrong = settle(*loaded, chosen)) {
        return *wrong;
    }
    auto state = std::make_unique<bake_state>();
    state->gl = std::move(loaded);
    state->chosen = chosen;
    state->cut = cut;
    state->group = std::min(chosen.group_width * chosen.group_height, most_invocations);
    return baker(std::move(state));
}

result<baker> baker::create(backend::get_proc_address loader, const options& chosen, const bake_gpu_options& cut)
{
    auto loaded = std::make_unique<functions>();
    if (const auto wrong = load(*loaded, loader)) {
        return *wrong;
    }
    return create(std::move(loaded), chosen, cut);
}

result<baker> baker::create(backend::get_proc_address_as_data loader, const options& chosen, const bake_gpu_options& cut)
{
    auto loaded = std::make_unique<functions>();
    if (const auto wrong = load(*loaded, loader)) {
        return *wrong;
    }
    return create(std::move(loaded), chosen, cut);
}

result<bake_sums> baker::run(const bake_job& job, const bake_request& request)
{
    bake_state& state = *state_;
    const functions& gl = *state.gl;
    const auto part = checked_request(job, request);
    if (!part) {
        return part.error();
    }
    const auto taken = detail::choose_bake_gpu_route(job, *part);
    if (!taken) {
        return taken.error();
    }
    const bake_route route = taken->route;
    bake_sums sums = detail::empty_bake_sums(*part, *taken);
    if (detail::nothing_to_bake(job, *part)) {
        return sums;
    }
    gl.take_error();
    const std::uint32_t group = detail::bake_group_of(route, state.group);
    const auto constants = detail::bake_gpu_constants_of(job, group);
    for (const detail::bake_shader shader : detail::bake_shaders_of(route)) {
        if (const auto program = bake_program_of(state, shader, constants); !program) {
            return program.error();
        }
    }
    const detail::bake_room room = detail::bake_room_of(job, *part, route, state.cut);
    const auto buffers = make_bake_buffers(gl, job, *part, route, room);
    if (!buffers) {
        return buffers.error();
    }
    const auto execute = [&](detail::bake_shader shader, const detail::bake_launch& launch, std::uint32_t x,
                             std::uint32_t y) -> std::optional<error> {
        const auto program = bake_program_of(state, shader, constants);
        if (!program) {
            return program.error();
        }
        return launch_bake(state, *buffers, *program, launch, x, y);
    };
    detail::bake_gpu_driver driver(job, *part, route, state.cut, room, group, execute);
    const auto end = driver.run();
    if (!end) {
        return end.error();
    }
    sums.last_vertex = end->last_vertex;
    sums.last_line = end->last_line;
    sums.sums.resize(sums.last_vertex - sums.first_vertex);
    if (!sums.sums.empty()) {
        gl.GetNamedBufferSubData(buffers->sums.name(), 0, static_cast<GLsizeiptr>(sums.sums.size() * sizeof(bake_sum)),
                                 sums.sums.data());
    }
    if (const GLenum code = gl.take_error(); code != GL_NO_ERROR) {
        return gl_error("reading the sums of the bake", code);
    }
    return sums;
}

} // namespace ao::gl
