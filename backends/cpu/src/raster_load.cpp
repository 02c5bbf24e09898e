#include "raster_state.hpp"

#include "ao/texture.hpp"

#include <algorithm>
#include <limits>
#include <new>
#include <stdexcept>
#include <utility>

namespace ao::cpu {

namespace {

constexpr std::uint32_t batch_count = 64;

// Cuts a mesh's triangles, in their order, into clusters.
class cluster_maker {
public:
    explicit cluster_maker(raster_model_state& into)
        : into_(into),
          seen_in_(into.arrays.streams[position_attribute].size() / 3, 0),
          local_(seen_in_.size(), 0)
    {
        into.local_indices.resize(into.arrays.indices.size());
    }
    cluster_range add(const placed_mesh& mesh)
    {
        cluster_range range{ count(), 0 };
        constexpr std::uint32_t most = 3 * triangle_cluster::most_triangles;
        for (std::uint32_t first = 0; first < mesh.index_count; first += most) {
            add_cluster(mesh, mesh.first_index + first, std::min(most, mesh.index_count - first));
        }
        range.last = count();
        return range;
    }

private:
    std::uint32_t count() const { return static_cast<std::uint32_t>(into_.clusters.size()); }
    glm::vec3 position(std::uint32_t vertex) const { return into_.attribute<glm::vec3>(position_attribute, vertex); }

    void add_cluster(const placed_mesh& mesh, std::uint32_t first_index, std::uint32_t indices)
    {
        triangle_cluster made{ first_index, indices, static_cast<std::uint32_t>(into_.cluster_vertices.size()), 0, {}, {} };
        const std::uint32_t mark = count() + 1;
        for (std::uint32_t i = first_index; i < first_index + indices; ++i) {
            const std::uint32_t vertex = into_.arrays.indices[i] + static_cast<std::uint32_t>(mesh.base_vertex);
            if (seen_in_[vertex] != mark) {
                seen_in_[vertex] = mark;
                local_[vertex] = static_cast<std::uint16_t>(made.vertex_count++);
                into_.cluster_vertices.push_back(vertex);
            }
            into_.local_indices[i] = local_[vertex];
        }
        made.low = made.high = position(into_.cluster_vertices[made.first_vertex]);
        for (std::uint32_t i = 1; i < made.vertex_count; ++i) {
            const glm::vec3 p = position(into_.cluster_vertices[made.first_vertex + i]);
            for (int axis = 0; axis < 3; ++axis) {
                made.low[axis] = std::min(made.low[axis], p[axis]);
                made.high[axis] = std::max(made.high[axis], p[axis]);
            }
        }
        into_.clusters.push_back(made);
    }

    raster_model_state& into_;
    std::vector<std::uint32_t> seen_in_; // by vertex: the last cluster that has it, plus 1
    std::vector<std::uint16_t> local_;   // its place there
};

// Batches of about as many triangles each.
void make_batches(raster_model_state& into)
{
    std::uint64_t total = 0;
    for (const raster_object& o : into.objects) {
        total += into.arrays.meshes[o.mesh].index_count;
    }
    const std::uint64_t share = total / batch_count + 1;
    std::uint64_t sum = 0;
    for (std::uint32_t slot = 0; slot < into.objects.size(); ++slot) {
        const cluster_range& range = into.mesh_clusters[into.objects[slot].mesh];
        for (std::uint32_t i = range.first; i < range.last; ++i) {
            if (sum >= share * into.batches.size()) {
                into.batches.push_back({ slot, i - range.first });
            }
            sum += into.clusters[i].index_count;
        }
    }
    into.batches.push_back({ static_cast<std::uint32_t>(into.objects.size()), 0 });
}

void set_transforms(const scene& s, raster_model_state& into)
{
    for (std::size_t slot = 0; slot < into.drawn.size(); ++slot) {
        into.objects[slot].instance = make_instance(s, into.drawn[slot]);
        if (into.facts.motion) {
            into.previous_models[slot] = make_previous_model(s, into.drawn[slot]);
        }
    }
}

std::optional<error> fill(const scene& s, const draw_plan& p, raster_model_state& into)
{
    into.facts = p.facts;
    into.variants = p.variants;
    into.drawn = make_drawn_objects(p);
    into.scene_objects = s.objects.size();
    into.arrays = gather_meshes(s, p);
    if (into.arrays.too_large) {
        return error(errc::out_of_memory, "the meshes have more than 2^31 vertices or indices");
    }
    for (const draw& d : p.draws) {
        const object& o = s.objects[static_cast<std::size_t>(d.object)];
        into.objects.push_back({ {}, static_cast<std::uint32_t>(o.mesh), static_cast<std::uint32_t>(d.variant) });
    }
    into.previous_models.resize(p.facts.motion ? p.draws.size() : 0);
    set_transforms(s, into);

    cluster_maker clusters(into);
    for (const placed_mesh& mesh : into.arrays.meshes) {
        into.mesh_clusters.push_back(clusters.add(mesh));
    }
    make_batches(into);

    const map_places maps = find_maps(s, p);
    into.materials = make_drawn_materials(s, maps);
    if (!maps.textures.empty()) {
        result<texel_heap> heap = make_texel_heap(maps.textures, std::numeric_limits<std::size_t>::max());
        if (!heap) {
            return heap.error();
        }
        into.heap = std::move(heap->words);
    }
    return std::nullopt;
}

} // namespace

result<raster_model> rasterizer::load(const scene& s, const draw_plan& p)
{
    try {
        auto state = std::make_unique<raster_model_state>();
        if (const auto wrong = fill(s, p, *state)) {
            return *wrong;
        }
        return raster_model(std::move(state));
    } catch (const std::bad_alloc&) {
        return error(errc::out_of_memory, "no memory for the scene");
    } catch (const std::length_error&) {
        return error(errc::out_of_memory, "the scene is larger than any memory");
    }
}

std::optional<error> rasterizer::move(model& loaded, const scene& s)
{
    raster_model_state& state = *loaded.state_;
    if (const auto wrong = check_moved(s, state.scene_objects, state.drawn)) {
        return wrong;
    }
    set_transforms(s, state);
    return std::nullopt;
}

} // namespace ao::cpu
