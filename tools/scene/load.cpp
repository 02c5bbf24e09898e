#include "load.hpp"

#include "apart.hpp"
#include "error.hpp"
#include "model_reader.hpp"
#include "scene_bytes.hpp"

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>

namespace ao::tools {
namespace {

bool finite(const aiVector3D& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Before the vertices of the file are joined and transformed: an index that means something to whoever wrote the file.
void check_vertices(const std::string& path, const aiScene& file)
{
    for (unsigned m = 0; m < file.mNumMeshes; ++m) {
        const aiMesh& mesh = *file.mMeshes[m];
        for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
            const bool position = finite(mesh.mVertices[i]);
            if (position && (!mesh.HasNormals() || finite(mesh.mNormals[i])))
                continue;
            throw error(path + ": vertex " + std::to_string(i) + " of mesh " + std::to_string(m) + " '" +
                        one_line(mesh.mName.C_Str()) + "': " + (position ? "normal" : "position") + " is not finite");
        }
    }
}

// Returns the size in bytes.
std::uintmax_t check_file(const std::string& path)
{
    std::error_code failure;
    const auto status = std::filesystem::status(path, failure);
    if (status.type() == std::filesystem::file_type::not_found)
        throw error(path + ": no such file");
    if (failure)
        throw error(path + ": " + failure.message());
    if (!std::filesystem::is_regular_file(status))
        throw error(path + ": not a regular file");
    const auto size = std::filesystem::file_size(path, failure);
    if (failure)
        throw error(path + ": " + failure.message());
    if (size == 0)
        throw error(path + ": the file is empty");
    return size;
}

// Assimp 5.2 reads a PLY header that never ends for ever.
void check_ply_header(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    std::string start(1 << 16, '\0');
    file.read(start.data(), static_cast<std::streamsize>(start.size()));
    start.resize(static_cast<std::size_t>(file.gcount()));
    if (start.rfind("ply", 0) == 0 && start.find("end_header") == std::string::npos)
        throw error(path + ": truncated, the PLY header has no end");
}

scene read_model(const std::string& path)
{
    Assimp::Importer importer;
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    const auto fail = [&] { throw error(path + ": " + one_line(importer.GetErrorString())); };

    // Validation runs first, so that no later step follows an index out of range.
    if (importer.ReadFile(path, aiProcess_ValidateDataStructure | aiProcess_Triangulate | aiProcess_SortByPType) == nullptr)
        fail();
    if (importer.GetScene()->mNumMeshes == 0)
        throw error(path + ": no triangles");
    check_vertices(path, *importer.GetScene());
    if (importer.ApplyPostProcessing(aiProcess_GenNormals | aiProcess_JoinIdenticalVertices) == nullptr)
        fail();

    const aiScene& file = *importer.GetScene();
    scene s;
    s.name = path;
    model_reader reader(file, s);
    reader.read_materials();
    reader.read_meshes();
    check(s);
    return s;
}

} // namespace

scene load_model(const std::string& path)
{
    const std::uintmax_t size = check_file(path);
    check_ply_header(path);
    // Textures take time, too, and their sizes are not known yet.
    const auto seconds = static_cast<unsigned>(std::min<std::uintmax_t>(60 + size / 500'000, 3600));
    scene s = scene_from_bytes(run_apart(path, seconds, [&] { return to_bytes(read_model(path)); }));
    for (const std::string& warning : s.warnings)
        std::cerr << "ao: warning: " << warning << '\n';
    return s;
}

} // namespace ao::tools
