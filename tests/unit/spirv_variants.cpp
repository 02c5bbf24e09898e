// A material without maps has fewer instructions and no texture, seen in the backends' SPIR-V after specialisation.
#include "unit/spirv_variant.hpp"

#ifdef AO_HAS_GL
#include "ao_gl_shaders.hpp"
#endif
#ifdef AO_HAS_VK
#include "ao_vk_shaders.hpp"
#endif

#include <catch2/catch.hpp>

#include <cstdint>
#include <map>
#include <ostream>
#include <set>
#include <span>
#include <string>
#include <vector>

using spirv_test::module_view;
using names = std::set<std::string>;

namespace {

// Constant ids of both backends' shaders/geometry.glsl and shaders/shading.glsl.
enum geometry_id : std::uint32_t { alpha_map, normal_map, uvs, write_position = 5, write_normal, hardware_sampling = 12 };
enum shading_id : std::uint32_t { stored_position, visibility = 3, maps, reflections, frames, blends, bent_normal = 11, bounces };

using constants = std::map<std::uint32_t, std::uint32_t>;
using module = std::span<const std::uint32_t>;

module_view variant(module m, const constants& c)
{
    return module_view(spirv_test::specialised(m, c));
}

const constants position_and_normal{ { write_position, 1 }, { write_normal, 1 } };

constants with(constants more)
{
    more.insert(position_and_normal.begin(), position_and_normal.end());
    return more;
}

void check_geometry(const std::string& backend, module vertex, module fragment, module hardware_fragment)
{
    const module_view plain = variant(fragment, position_and_normal);
    const module_view alpha = variant(fragment, with({ { alpha_map, 1 }, { uvs, 1 } }));
    const module_view normals = variant(fragment, with({ { normal_map, 1 }, { uvs, 1 } }));
    const module_view both = variant(fragment, with({ { alpha_map, 1 }, { normal_map, 1 }, { uvs, 1 } }));
    const module_view sampler =
        variant(hardware_fragment, with({ { alpha_map, 1 }, { normal_map, 1 }, { uvs, 1 }, { hardware_sampling, 1 } }));
    const module_view bare = variant(hardware_fragment, position_and_normal);
    WARN(backend << ", instructions of a fragment: " << plain.instructions() << " without maps, " << alpha.instructions()
                 << " with alpha, " << normals.instructions() << " with normals, " << both.instructions() << " with both, "
                 << sampler.instructions() << " with both by the driver's sampler");
    CHECK(plain.instructions() < sampler.instructions());
    CHECK(sampler.instructions() < alpha.instructions());
    CHECK(plain.instructions() < normals.instructions());
    CHECK(alpha.instructions() < both.instructions());
    CHECK(normals.instructions() < both.instructions());

    CHECK(plain.resources() == names{});
    CHECK(bare.resources() == names{});
    CHECK(bare.instructions() == plain.instructions());
    CHECK(alpha.resources() == names{ "heap_block", "materials_block" });
    CHECK(normals.resources() == names{ "heap_block", "materials_block" });
    CHECK(sampler.resources() == names{ "alpha_picture", "materials_block", "normal_picture" });

    // Nothing is discarded, no tangent and no uv is read unless a map asks for it.
    CHECK_FALSE(plain.has(module_view::op_kill));
    CHECK_FALSE(normals.has(module_view::op_kill));
    CHECK(alpha.has(module_view::op_kill));
    CHECK(plain.inputs() == names{ "gl_FrontFacing", "normal", "position" });
    CHECK(normals.inputs() == names{ "gl_FrontFacing", "ids", "normal", "position", "tangent", "uv" });

    const module_view bare_vertex = variant(vertex, position_and_normal);
    const module_view full_vertex = variant(vertex, with({ { alpha_map, 1 }, { normal_map, 1 }, { uvs, 1 } }));
    WARN(backend << ", instructions of a vertex: " << bare_vertex.instructions() << " without maps, "
                 << full_vertex.instructions() << " with both");
    CHECK(bare_vertex.instructions() < full_vertex.instructions());
    CHECK(bare_vertex.inputs().count("tangent") + bare_vertex.inputs().count("uv") == 0);
    CHECK(full_vertex.inputs().count("tangent") + full_vertex.inputs().count("uv") == 2);
    CHECK(bare_vertex.resources() == names{ "camera_block", "instances_block" });
}

void check_shading(const std::string& backend, module shade, const names& always)
{
    const auto also = [&](names more) {
        more.insert(always.begin(), always.end());
        return more;
    };
    const module_view plain = variant(shade, { { stored_position, 1 } });
    const module_view seen = variant(shade, { { stored_position, 1 }, { visibility, 1 } });
    const module_view mapped = variant(shade, { { stored_position, 1 }, { visibility, 1 }, { maps, 1 } });
    const module_view mirror = variant(shade, { { stored_position, 1 }, { visibility, 1 }, { reflections, 1 } });
    const module_view blended = variant(shade, { { stored_position, 1 }, { visibility, 1 }, { blends, 1 } });
    const module_view all = variant(
        shade, { { stored_position, 1 }, { visibility, 1 }, { maps, 1 }, { reflections, 1 }, { frames, 1 }, { blends, 1 } });
    WARN(backend << ", instructions of shading: " << plain.instructions() << " plain, " << seen.instructions()
                 << " with visibility, " << mapped.instructions() << " with maps too, " << mirror.instructions()
                 << " with reflections too, " << blended.instructions() << " with blends too, " << all.instructions()
                 << " with everything");
    const module_view bent = variant(shade, { { stored_position, 1 }, { visibility, 1 }, { bent_normal, 1 } });
    const module_view bounced = variant(shade, { { stored_position, 1 }, { visibility, 1 }, { bounces, 1 } });
    WARN(backend << ", instructions of shading with visibility: " << bent.instructions() << " along bent normals, "
                 << bounced.instructions() << " with bounces");
    CHECK(seen.instructions() < bent.instructions());
    CHECK(seen.instructions() < bounced.instructions());
    // The direction lies beside visibility.
    CHECK(bent.resources() == seen.resources());
    CHECK(bounced.resources() == seen.resources());
    CHECK(plain.instructions() < seen.instructions());
    CHECK(seen.instructions() < mapped.instructions());
    CHECK(seen.instructions() < mirror.instructions());
    CHECK(seen.instructions() < blended.instructions());
    CHECK(mapped.instructions() < all.instructions());
    CHECK(plain.resources() == also({}));
    CHECK(seen.resources() == also({ "visibility_picture" }));
    CHECK(mapped.resources() == also({ "visibility_picture", "heap_block", "surface_picture" }));
    CHECK(mirror.resources() == also({ "visibility_picture", "heap_block" }));
    CHECK(blended.resources() == also({ "visibility_picture", "statistics_block", "targets" }));
    CHECK(all.resources() ==
          also({ "visibility_picture", "heap_block", "surface_picture", "frame_picture", "statistics_block", "targets" }));
}

// What bent normals add to an estimate and to a window of the denoiser.
void check_bent(const std::string& backend, const module_view& lean, const module_view& bent)
{
    WARN(backend << ", instructions: " << lean.instructions() << ", " << bent.instructions() << " with bent normals");
    CHECK(lean.instructions() < bent.instructions());
    CHECK(lean.resources() == bent.resources());
}

} // namespace

#ifdef AO_HAS_GL
TEST_CASE("OpenGL's estimates and denoiser have nothing of bent normals where these are not asked for")
{
    using namespace ao::gl::shaders;
    // Constant ids of shaders/bitmask.glsl and denoise.glsl: 6 packed output, 13 bent normals.
    check_bent("gl, bitmask", variant(bitmask_comp, { { 6, 1 } }), variant(bitmask_comp, { { 6, 1 }, { 13, 1 } }));
    check_bent("gl, denoise rows", variant(denoise_rows_comp, {}), variant(denoise_rows_comp, { { 13, 1 } }));
    check_bent("gl, denoise columns", variant(denoise_columns_comp, {}), variant(denoise_columns_comp, { { 13, 1 } }));
}
#endif

#ifdef AO_HAS_VK
TEST_CASE("Vulkan's estimates and denoiser have nothing of bent normals where these are not asked for")
{
    using namespace ao::vk::shaders;
    check_bent("vk, bitmask", variant(bitmask_comp_packed, {}), variant(bitmask_comp_bent_packed, {}));
    check_bent("vk, denoise rows", variant(denoise_rows_comp, {}), variant(denoise_rows_comp_bent, {}));
    check_bent("vk, denoise columns", variant(denoise_columns_comp, {}), variant(denoise_columns_comp_bent, {}));
}
#endif

#ifdef AO_HAS_GL
TEST_CASE("OpenGL's shaders read what materials need and no more")
{
    using namespace ao::gl::shaders;
    check_geometry("gl", geometry_vert, geometry_frag, geometry_frag);
    check_shading("gl", shade_comp,
                  { "constants_block", "geometry_picture", "ids_picture", "normal_picture", "picture", "table_block" });
}
#endif

#ifdef AO_HAS_VK
TEST_CASE("Vulkan's shaders read what materials need and no more")
{
    using namespace ao::vk::shaders;
    check_geometry("vk", geometry_vert, geometry_frag, geometry_frag_hardware);
    check_shading("vk", shade_comp,
                  { "color_picture", "geometry_picture", "ids_picture", "normal_picture", "pass_constants", "table_block" });
}
#endif
