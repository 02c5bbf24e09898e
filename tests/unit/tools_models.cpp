#include "ao/scene_check.hpp"
#include "scene/drawn.hpp"
#include "scene/load.hpp"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <filesystem>
#include <string>

// Models of the package assimp-testmodels.
namespace {

using namespace ao::tools;

const std::filesystem::path models = "/usr/share/assimp/models";

struct expected {
    const char* path;
    std::size_t textures;
    std::size_t missing;
    bool normal_maps;
    bool alpha;
};

std::size_t mirrored(const scene& s)
{
    return static_cast<std::size_t>(
        std::count_if(s.tangents.begin(), s.tangents.end(), [](const glm::vec4& t) { return t.w < 0.0f; }));
}

} // namespace

TEST_CASE("textured models that others made", "[tools][models]")
{
    if (!std::filesystem::exists(models)) {
        WARN("skipped: " << models << " is missing, install assimp-testmodels");
        return;
    }
    const expected all[] = { { "OBJ/spider.obj", 5, 0, false, false },
                             { "glTF2/ClearCoat-glTF/ClearCoatTest.gltf", 3, 0, true, true },
                             { "glTF2/BoxTextured-glTF/BoxTextured.gltf", 1, 0, false, false },
                             { "glTF2/BoxTextured-glTF-Binary/BoxTextured.glb", 1, 0, false, false },
                             { "glTF2/BoxTextured-glTF-Embedded/BoxTextured.gltf", 1, 0, false, false },
                             { "glTF2/textureTransform/TextureTransformTest.gltf", 5, 0, false, false },
                             { "FBX/box_orphant_embedded_texture.fbx", 1, 0, false, false },
                             { "FBX/spider.fbx", 4, 4, false, false },
                             { "Collada/duck.dae", 1, 0, false, false },
                             { "X/test.x", 1, 0, false, false },
                             { "3DS/cube_with_diffuse_texture.3DS", 1, 0, false, false },
                             { "MDL/MDL (HL1)/alpha_test.mdl", 1, 0, false, true },
                             { "MS3D/jeep1.ms3d", 1, 0, false, false } };
    for (const expected& e : all) {
        INFO(e.path);
        const scene s = load_model((models / e.path).string());
        CHECK(s.textures.size() == e.textures);
        CHECK(static_cast<std::size_t>(std::count_if(s.textures.begin(), s.textures.end(),
                                                     [](const scene_texture& t) { return t.missing; })) == e.missing);
        CHECK(s.warnings.size() == e.missing);
        const auto some = [&](int ao::standard_material::*map) {
            return std::any_of(s.materials.begin(), s.materials.end(), [&](const auto& m) { return m.*map != ao::no_texture; });
        };
        CHECK(some(&ao::standard_material::diffuse_map));
        CHECK(some(&ao::standard_material::normal_map) == e.normal_maps);
        CHECK(some(&ao::standard_material::alpha_map) == e.alpha);
        CHECK(s.tangents.empty() != e.normal_maps);
        CHECK(mirrored(s) == 0);
        const scene_view view(s);
        CHECK_FALSE(ao::validate(view.get()));
        CHECK(view.get().objects.size() == s.object_names.size());
    }
}
