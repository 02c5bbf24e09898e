// Ambient occlusion per vertex in OpenGL 4.5 core, by compute shaders: a baker for ao/bake.hpp.
//
//     auto gl = ao::gl::baker::create(glfwGetProcAddress);
//     auto sums = gl->run(*job, {});
//     ao::bake_result baked = ao::finish_bake(*job, *sums);
//
// Routes: brute, tiled, packed, hierarchy, raster (bake_route), all with the same bits, and cube, which looks directions up in a
// cube map of bake_gpu_options::cube_texels around each vertex (docs/numerics.md, "Per vertex"). Packed has no fall-off; packed
// and raster have no rules that differ per vertex. run() makes buffers, dispatches and waits, again and again: launches are cut
// to bake_gpu_options::launch_seconds, and bake_request::progress is called between them, where the host may use the context.
// Where progress ends the bake, the sums are those of the vertices that were finished along all lines of the part; by raster
// those of all vertices along the lines that were finished.
//
// Context, errors and lifetimes are as in ao/gl/backend.hpp; options::route is not looked at, and the product of the group's
// width and height says how many invocations a group has, 256 at most. Memory as in ao/vk/bake.hpp.
//
// State. With options::restore_state (the default) run() leaves all state as it was, between launches too. Without it, it leaves
// changed: the current program; buffer textures and samplers of units 0 to 5; uniform buffer binding 0 and shader storage
// bindings 0 to 2 with their generic bindings.
#pragma once

#include "ao/bake_gpu.hpp"
#include "ao/gl/backend.hpp"

#include <memory>

namespace ao::gl {

struct bake_state;

// One thread at a time. The context must be current when it is destroyed.
class baker {
public:
    // Fails as backend::create does.
    static result<baker> create(backend::get_proc_address loader, const options& chosen = {}, const bake_gpu_options& cut = {});
    static result<baker> create(backend::get_proc_address_as_data loader, const options& chosen = {},
                                const bake_gpu_options& cut = {});

    baker(baker&&) noexcept;
    baker& operator=(baker&&) noexcept;
    ~baker();

    // Whether run() takes this route; true of automatic.
    static bool has(bake_route route) { return detail::has_bake_gpu_route(route); }

    // errc::invalid_settings: a part that is not one; errc::unsupported_format: a route that this backend does not have, or not
    // for these settings; errc::out_of_memory: tables beyond the driver's limits, and which; errc::shader; errc::device.
    result<bake_sums> run(const bake_job& job, const bake_request& request = {});

    // With what automatic has come to.
    const options& chosen() const;

private:
    explicit baker(std::unique_ptr<bake_state> state);
    static result<baker> create(std::unique_ptr<functions> loaded, options chosen, const bake_gpu_options& cut);

    std::unique_ptr<bake_state> state_;
};

} // namespace ao::gl
