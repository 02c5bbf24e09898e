#include "raster_setup.hpp"

#include "raster_clip.hpp"
#include "raster_outside.hpp"

#include <algorithm>

namespace ao::cpu {

namespace {

struct corner {
    glm::vec4 clip;
    glm::ivec2 at; // snapped, where neither clipped nor unusable
    unsigned outside;
};

// First and last whole multiple of 256 between two snapped coordinates, over 256, within 0 ... size - 1.
struct pixel_range {
    int first;
    int last;

    pixel_range(int low, int high, int size) : first(std::max((low + subpixels - 1) >> 8, 0)), last(std::min(high >> 8, size - 1))
    {
    }
    bool empty() const { return first > last; }
};

class batch_setup {
public:
    batch_setup(const raster_model_state& model, const raster_view& view, const tile_grid& grid, triangle_bins& into)
        : model_(model),
          view_(view),
          grid_(grid),
          into_(into)
    {
    }
    void add(std::uint32_t slot, const triangle_cluster& cluster)
    {
        slot_ = slot;
        const raster_object& object = model_.objects[slot];
        variant_ = &model_.variants[object.variant];
        // Of fewer vertices each is looked at sooner than a box.
        if (cluster.vertex_count > 24 && unseen(view_, object.instance, cluster)) {
            return;
        }
        for (std::uint32_t i = 0; i < cluster.vertex_count; ++i) {
            const std::uint32_t vertex = model_.cluster_vertices[cluster.first_vertex + i];
            corner& c = corners_[i];
            c.clip = view_.clip_position(object.instance, model_.attribute<glm::vec3>(position_attribute, vertex));
            c.outside = classify(view_, c.clip);
            if ((c.outside & (needs_clipping | not_usable)) == 0) {
                c.at = view_.snapped(c.clip);
            }
        }
        for (std::uint32_t i = 0; i < cluster.index_count; i += 3) {
            const std::uint16_t* local = &model_.local_indices[cluster.first_index + i];
            add_triangle(cluster.first_index + i, corners_[local[0]], corners_[local[1]], corners_[local[2]]);
        }
    }

private:
    bool front(bool clockwise) const { return clockwise == (variant_->mirrored == view_.turned); }

    void add_triangle(std::uint32_t first_index, const corner& a, const corner& b, const corner& c)
    {
        const unsigned any = a.outside | b.outside | c.outside;
        if ((a.outside & b.outside & c.outside) != 0 || (any & not_usable) != 0) {
            return;
        }
        first_index_ = first_index;
        if ((any & needs_clipping) != 0) {
            add_clipped({ a.clip, b.clip, c.clip });
            return;
        }
        const std::int64_t area = doubled_area(a.at, b.at, c.at);
        if (area == 0 || (variant_->cull_back && !front(area > 0)) || !covers(a.at, b.at, c.at)) {
            return;
        }
        set_up_depth({ a.clip, b.clip, c.clip }, false);
        if (planes_.determinant != 0) {
            bin(a.at, b.at, c.at, area > 0, front(area > 0));
        }
    }

    void add_clipped(const std::array<glm::vec4, 3>& corners)
    {
        const clipped_polygon p = clip_triangle(view_, corners);
        if (p.count < 3) {
            return;
        }
        set_up_depth(corners, true);
        const bool clockwise = planes_.determinant > 0;
        if (planes_.determinant == 0 || (variant_->cull_back && !front(clockwise))) {
            return;
        }
        std::array<glm::ivec2, 9> at;
        for (std::size_t i = 0; i < p.count; ++i) {
            at[i] = view_.snapped(p.corners[i]);
        }
        for (std::size_t i = 2; i < p.count; ++i) {
            const std::int64_t area = doubled_area(at[0], at[i - 1], at[i]);
            // Pieces that snapping turned around lie within others.
            if (area != 0 && (area > 0) == clockwise && covers(at[0], at[i - 1], at[i])) {
                bin(at[0], at[i - 1], at[i], clockwise, front(clockwise));
            }
        }
    }

    // Whether the bounding box holds a pixel centre.
    bool covers(glm::ivec2 a, glm::ivec2 b, glm::ivec2 c) const
    {
        const auto range = [](int i, int j, int k, int size) {
            return pixel_range(std::min(std::min(i, j), k), std::max(std::max(i, j), k), size);
        };
        return !range(a.x, b.x, c.x, model_.facts.width).empty() && !range(a.y, b.y, c.y, model_.facts.height).empty();
    }

    void set_up_depth(const std::array<glm::vec4, 3>& clip, bool clipped)
    {
        planes_ = corner_weights(view_, clip);
        clipped_ = clipped;
        depth_ = glm::dvec3(0.0);
        double least = 1;
        double greatest = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const double z = static_cast<double>(clip[i].z);
            depth_.x += planes_.edges[i].x * z;
            depth_.y += planes_.edges[i].y * z;
            depth_.z += planes_.edges[i].z * z;
            if (!clipped) {
                const double stored = to_stored(z / static_cast<double>(clip[i].w));
                least = std::min(least, stored);
                greatest = std::max(greatest, stored);
            }
        }
        if (clipped) {
            std::swap(least, greatest);
        }
        const double sign = static_cast<double>(view_.key_sign);
        const double scale = view_.zero_to_one ? sign : 0.5 * sign;
        depth_ *= scale;
        depth_.z += view_.zero_to_one ? 0 : 0.5 * sign;
        limits_ = { static_cast<float>(std::clamp(sign > 0 ? least : greatest, 0.0, 1.0) * sign),
                    static_cast<float>(std::clamp(sign > 0 ? greatest : least, 0.0, 1.0) * sign) };
    }
    double to_stored(double ndc) const { return view_.zero_to_one ? ndc : ndc * 0.5 + 0.5; }

    // Precondition: covers.
    void bin(glm::ivec2 a, glm::ivec2 b, glm::ivec2 c, bool clockwise, bool front)
    {
        if (!clockwise) {
            std::swap(b, c);
        }
        raster_triangle t{ { a.x, b.x, c.x }, { a.y, b.y, c.y }, depth_.x, depth_.y,     depth_.z,
                           limits_.x,         limits_.y,         slot_,    first_index_, front,
                           clipped_ };
        const pixel_range across(std::min(std::min(a.x, b.x), c.x), std::max(std::max(a.x, b.x), c.x), model_.facts.width);
        const pixel_range down(std::min(std::min(a.y, b.y), c.y), std::max(std::max(a.y, b.y), c.y), model_.facts.height);
        const auto index = static_cast<std::uint32_t>(into_.triangles.size());
        const int left = across.first / grid_.width;
        const int right = across.last / grid_.width;
        const int top = down.first / grid_.height;
        const int bottom = down.last / grid_.height;
        const bool many = left != right || top != bottom;
        bool seen = false;
        for (int row = top; row <= bottom; ++row) {
            for (int column = left; column <= right; ++column) {
                if (!many || touches(t, column, row)) {
                    into_.tiles.push_back(static_cast<std::uint32_t>(row * grid_.columns + column));
                    into_.owners.push_back(index);
                    seen = true;
                }
            }
        }
        if (seen) {
            into_.triangles.push_back(t);
        }
    }

    // False where all pixel centres of a tile lie beyond one edge.
    bool touches(const raster_triangle& t, int column, int row) const
    {
        const std::int64_t left = std::int64_t{ column } * grid_.width * subpixels;
        const std::int64_t top = std::int64_t{ row } * grid_.height * subpixels;
        const std::int64_t right = left + std::int64_t{ grid_.width - 1 } * subpixels;
        const std::int64_t bottom = top + std::int64_t{ grid_.height - 1 } * subpixels;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = i < 2 ? i + 1 : 0;
            const std::int64_t dx = t.x[j] - t.x[i];
            const std::int64_t dy = t.y[j] - t.y[i];
            const std::int64_t x = (dy > 0 ? left : right) - t.x[i];
            const std::int64_t y = (dx > 0 ? bottom : top) - t.y[i];
            if (dx * y - dy * x < 0) {
                return false;
            }
        }
        return true;
    }

    const raster_model_state& model_;
    const raster_view& view_;
    const tile_grid& grid_;
    triangle_bins& into_;
    const draw_variant* variant_ = nullptr;
    std::uint32_t slot_ = 0;
    std::uint32_t first_index_ = 0;
    corner_weights planes_;
    glm::dvec3 depth_{ 0.0 };
    glm::vec2 limits_{ 0.0F };
    bool clipped_ = false;
    std::array<corner, triangle_cluster::most_vertices> corners_;
};

// By tile, in the order of the triangles.
void sort_tiles(triangle_bins& bins, int tiles)
{
    bins.starts.assign(static_cast<std::size_t>(tiles) + 1, 0);
    for (const std::uint32_t tile : bins.tiles) {
        ++bins.starts[tile + 1];
    }
    for (std::size_t i = 1; i < bins.starts.size(); ++i) {
        bins.starts[i] += bins.starts[i - 1];
    }
    // From the last on, each count steps down to its tile's start: after that, starts[i + 1] is where tile i begins.
    bins.sorted.resize(bins.tiles.size());
    for (std::size_t i = bins.tiles.size(); i-- > 0;) {
        bins.sorted[--bins.starts[bins.tiles[i] + 1]] = bins.owners[i];
    }
    for (std::size_t i = 1; i < bins.starts.size(); ++i) {
        bins.starts[i - 1] = bins.starts[i];
    }
    bins.starts.back() = static_cast<std::uint32_t>(bins.sorted.size());
}

} // namespace

void set_up_batch(const raster_model_state& model, const raster_view& view, std::size_t batch, const tile_grid& grid,
                  triangle_bins& into)
{
    into.triangles.clear();
    into.tiles.clear();
    into.owners.clear();
    batch_setup setup(model, view, grid, into);
    batch_start at = model.batches[batch];
    const batch_start end = model.batches[batch + 1];
    while (at.slot != end.slot || at.cluster != end.cluster) {
        const cluster_range& range = model.mesh_clusters[model.objects[at.slot].mesh];
        setup.add(at.slot, model.clusters[range.first + at.cluster]);
        if (range.first + ++at.cluster == range.last) {
            at = { at.slot + 1, 0 };
        }
    }
    sort_tiles(into, grid.count());
}

} // namespace ao::cpu
