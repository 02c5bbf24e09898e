#include "model_reader.hpp"

#include "error.hpp"
#include "tangents.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace ao::tools {
namespace {

glm::vec3 to_vec3(const aiVector3D& v)
{
    return { v.x, v.y, v.z };
}

// A vertex without a direction becomes one vertex per face around it, with that face's normal.
void split_undirected(scene& s, std::size_t first_triangle)
{
    for (std::size_t t = first_triangle; t < s.triangles.size(); ++t) {
        const glm::uvec3 corners = s.triangles[t];
        const glm::dvec3 a = s.positions[corners.x];
        const glm::dvec3 cross = glm::cross(glm::dvec3(s.positions[corners.y]) - a, glm::dvec3(s.positions[corners.z]) - a);
        const double length = glm::length(cross);
        const glm::vec3 face = length > 0.0 ? glm::vec3(cross / length) : glm::vec3(0.0f, 1.0f, 0.0f);
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint32_t v = corners[corner];
            if (s.normals[v] != glm::vec3(0.0f))
                continue;
            s.triangles[t][corner] = static_cast<std::uint32_t>(s.positions.size());
            s.positions.push_back(glm::vec3(s.positions[v]));
            s.normals.push_back(face);
            s.uvs.push_back(glm::vec2(s.uvs[v]));
        }
    }
    // What the loop left behind is used by no triangle.
    for (glm::vec3& n : s.normals)
        if (n == glm::vec3(0.0f))
            n = glm::vec3(0.0f, 1.0f, 0.0f);
}

glm::vec3 unit_or_zero(const glm::dvec3& v)
{
    const double length = glm::length(v);
    return length > 0.0 && std::isfinite(length) ? glm::vec3(v / length) : glm::vec3(0.0f);
}

glm::dvec3 to_dvec3(const aiVector3D& v)
{
    return to_vec3(v);
}

} // namespace

void model_reader::embed_textures(texture_shelf& shelf) const
{
    for (unsigned i = 0; i < file.mNumTextures; ++i) {
        const aiTexture& t = *file.mTextures[i];
        picture p;
        std::string reason;
        try {
            p = decode_embedded(t);
        } catch (const error& e) {
            reason = e.what();
        }
        for (const std::string& name : { std::string("*").append(std::to_string(i)), std::string(t.mFilename.C_Str()) }) {
            if (name.empty())
                continue;
            if (reason.empty())
                shelf.embed(name, p);
            else
                shelf.embed_broken(name, reason);
        }
    }
}

void model_reader::read_materials()
{
    texture_shelf shelf(s, std::filesystem::path(s.name).parent_path());
    embed_textures(shelf);
    for (unsigned m = 0; m < file.mNumMaterials; ++m) {
        s.material_names.push_back(one_line(file.mMaterials[m]->GetName().C_Str()));
        materials.push_back(read_one(*file.mMaterials[m], s.name, shelf, s));
    }
    if (s.material_names.empty()) {
        s.material_names.push_back("default");
        materials.emplace_back();
    }
    unmapped.resize(materials.size(), -1);
    for (const read_material& m : materials) {
        s.materials.push_back(m.material);
        with_tangents = with_tangents || m.material.normal_map != ao::no_texture;
    }
}

std::uint32_t model_reader::drawn_material(const aiMesh& mesh, bool has_uvs, const std::string& object_name)
{
    const std::uint32_t own = mesh.mMaterialIndex;
    if (has_uvs || !has_maps(materials[own].material))
        return own;
    if (unmapped[own] < 0) {
        unmapped[own] = static_cast<int>(s.materials.size());
        const std::string name = s.material_names[own];
        s.warnings.push_back(s.name + ": '" + object_name + "' has no texture coordinates for material '" + name +
                             "', whose maps are left out there");
        s.material_names.push_back(name + " without maps");
        s.materials.push_back(without_maps(materials[own].material));
    }
    return static_cast<std::uint32_t>(unmapped[own]);
}

// One for every vertex added without; false where the mesh has none.
bool model_reader::add_uvs(const aiMesh& mesh)
{
    const read_material& m = materials[mesh.mMaterialIndex];
    const bool has = m.uv_set < AI_MAX_NUMBER_OF_TEXTURECOORDS && mesh.HasTextureCoords(m.uv_set);
    bool sound = true;
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
        glm::vec2 uv{ 0.0f };
        if (has) {
            const aiVector3D& from = mesh.mTextureCoords[m.uv_set][i];
            // Assimp counts v from below.
            uv = m.turn * glm::vec2(from.x, 1.0f - from.y) + m.shift;
            if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) {
                uv = glm::vec2(0.0f);
                sound = false;
            }
        }
        s.uvs.push_back(uv);
    }
    if (!sound)
        s.warnings.push_back(s.name + ": '" + one_line(mesh.mName.C_Str()) +
                             "': texture coordinates that are not finite count as 0");
    return has;
}

// Those of the file, for the vertices from first_vertex on. False where it has none that can be used.
bool model_reader::add_own_tangents(const aiMesh& mesh, const glm::dmat3& to_world, std::size_t first_vertex) const
{
    const read_material& m = materials[mesh.mMaterialIndex];
    if (!mesh.HasTangentsAndBitangents() || m.uv_set != 0 || m.turn != glm::mat2(1.0f))
        return false;
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
        const glm::dvec3 normal = s.normals[first_vertex + i];
        const glm::dvec3 along = to_world * to_dvec3(mesh.mTangents[i]);
        const glm::vec3 tangent = unit_or_zero(along - glm::dot(along, normal) * normal);
        const double side = glm::dot(glm::cross(normal, along), to_world * to_dvec3(mesh.mBitangents[i]));
        s.tangents.push_back(
            glm::vec4(tangent == glm::vec3(0.0f) ? any_across(glm::vec3(normal)) : tangent, side < 0.0 ? -1.0f : 1.0f));
    }
    return true;
}

void model_reader::add_mesh(const aiMesh& mesh, const aiMatrix4x4& to_world, const std::string& object_name)
{
    if ((mesh.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) == 0)
        return;
    const auto base = static_cast<std::uint32_t>(s.positions.size());
    const auto first_triangle = s.triangles.size();
    const auto object = static_cast<std::uint32_t>(s.object_names.size());
    s.object_names.push_back(object_name);

    // Normals go by the inverse transpose, here as cross products of the columns so that a flat node (scale 0) is no
    // division by zero.
    const glm::dmat3 axes{ glm::dvec3(to_world.a1, to_world.b1, to_world.c1), glm::dvec3(to_world.a2, to_world.b2, to_world.c2),
                           glm::dvec3(to_world.a3, to_world.b3, to_world.c3) };
    const bool mirrored = glm::dot(axes[0], glm::cross(axes[1], axes[2])) < 0.0;
    const glm::dmat3 of_normals{ glm::cross(axes[1], axes[2]), glm::cross(axes[2], axes[0]), glm::cross(axes[0], axes[1]) };
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
        s.positions.push_back(to_vec3(to_world * mesh.mVertices[i]));
        glm::dvec3 normal{ 0.0 };
        if (mesh.HasNormals())
            normal = of_normals * to_dvec3(mesh.mNormals[i]) * (mirrored ? -1.0 : 1.0);
        s.normals.push_back(unit_or_zero(normal));
    }
    const bool has_uvs = add_uvs(mesh);
    s.object_has_uvs.push_back(has_uvs ? 1 : 0);
    const std::uint32_t material = drawn_material(mesh, has_uvs, object_name);
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
        const aiFace& face = mesh.mFaces[f];
        if (face.mNumIndices != 3)
            continue;
        // Under a node that mirrors, front faces would wind the other way.
        const unsigned last = mirrored ? 1 : 2;
        s.triangles.push_back({ base + face.mIndices[0], base + face.mIndices[3 - last], base + face.mIndices[last] });
        s.object.push_back(object);
        s.material.push_back(material);
    }
    split_undirected(s, first_triangle);
    if (!with_tangents)
        return;
    // Vertices that were split off have tangents of their own made, as all others then.
    const bool split = s.positions.size() != base + std::size_t{ mesh.mNumVertices };
    if (split || !has_uvs || !add_own_tangents(mesh, axes, base))
        add_tangents(s, base, first_triangle);
}

void model_reader::add_node(const aiNode& node, const aiMatrix4x4& parent_to_world)
{
    const aiMatrix4x4 to_world = parent_to_world * node.mTransformation;
    for (unsigned m = 0; m < node.mNumMeshes; ++m) {
        const aiMesh& mesh = *file.mMeshes[node.mMeshes[m]];
        const std::string node_name = node.mName.C_Str();
        const std::string mesh_name = mesh.mName.C_Str();
        add_mesh(mesh, to_world, one_line(node_name.empty() ? mesh_name : node_name));
    }
    for (unsigned c = 0; c < node.mNumChildren; ++c)
        add_node(*node.mChildren[c], to_world);
}

void model_reader::read_meshes()
{
    add_node(*file.mRootNode, aiMatrix4x4());
    if (std::count(s.object_has_uvs.begin(), s.object_has_uvs.end(), 1) == 0)
        s.uvs.clear();
}

} // namespace ao::tools
