// Ambient occlusion per vertex on Vulkan 1.1, by compute shaders: a baker for ao/bake.hpp.
//
//     auto vk = ao::vk::baker::create({ instance, physical_device, device, vkGetInstanceProcAddr }, { queue, family });
//     auto sums = vk->run(*job, {});
//     ao::bake_result baked = ao::finish_bake(*job, *sums);
//
// Routes: brute, tiled, packed, hierarchy, raster (bake_route), all with the same bits, and cube, which looks directions up in a
// cube map of bake_gpu_options::cube_texels around each vertex (docs/numerics.md, "Per vertex"). Packed has no fall-off; packed
// and raster have no rules that differ per vertex. run() makes buffers, submits to the queue and waits, again and again: launches
// are cut to bake_gpu_options::launch_seconds, and bake_request::progress is called between them. While it runs nothing else
// submits to the queue. Where progress ends the bake, the sums are those of the vertices that were finished along all lines of
// the part; by raster those of all vertices along the lines that were finished.
//
// Memory on the device, bytes: 32 a vertex, 16 a triangle, 16 a point, 48 a line, 32 a vertex of the part, 48 more where the rule
// is turned at each; hierarchy: 64 a triangle; packed and raster: bake_gpu_options::scratch, and half as much besides (with
// fall-off three times); packed as much as two bits for every direction of 65536 vertices; cube: scratch, at least 16 cube maps.
// While tables are uploaded, and sums read back, once more the same on the host's side. Device features: none.
#pragma once

#include "ao/bake_gpu.hpp"
#include "ao/vk/backend.hpp"

#include <cstdint>
#include <memory>

namespace ao::vk {

// Of context::device, with compute.
struct compute_queue {
    VkQueue queue = VK_NULL_HANDLE;
    std::uint32_t family = 0;
};

struct bake_state;

// One thread at a time. context::group says how many invocations a group has, 256 at most.
class baker {
public:
    // Fails as backend::create does; errc::device without a queue.
    static result<baker> create(const context& c, const compute_queue& queue, const bake_gpu_options& options = {});
    baker(baker&&) noexcept;
    baker& operator=(baker&&) noexcept;
    ~baker();

    // Whether run() takes this route; true of automatic.
    static bool has(bake_route route) { return detail::has_bake_gpu_route(route); }

    // errc::invalid_settings: a part that is not one; errc::unsupported_format: a route that this backend does not have, or not
    // for these settings; errc::out_of_memory: tables beyond the device's limits, and which; errc::device.
    result<bake_sums> run(const bake_job& job, const bake_request& request = {});

private:
    explicit baker(std::unique_ptr<bake_state> state);
    std::unique_ptr<bake_state> state_;
};

} // namespace ao::vk
