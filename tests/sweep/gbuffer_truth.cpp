// What a rasterizer may store at a pixel of a triangle.
//
// Snapping. Corners move to the nearest of 256 positions a pixel, by at most h = 1/512 pixel along each axis, while their
// attributes stay. Let A be the affine map from the corners to the moved ones: what is stored at q is what the exact triangle has
// at A^-1 q. q is a convex combination of the moved corners and A^-1 q the same one of the corners, so both are at most h apart
// along each axis. The image of that square under the perspective map onto the triangle's plane is a convex quadrilateral, in
// which the distance from the exact point is greatest at a corner: position_bound begins with the greatest of four distances,
// which is the plane's screen gradient times h to first order. Nor is what is stored further away than the triangle's farthest
// corner: that is the bound where the square reaches the horizon of a plane seen edge-on. The same holds for normals before they
// are made unit; making vectors unit turns a difference of d into at most 2 d / length.
//
// Corners' pixel coordinates are rounded to float: 4 roundings of at most e = 2^-24 of the greatest coordinate, which drivers
// clip to a guard band (ours to 16384 pixels around the picture). They are added to h.
//
// Corners in view space are three products and sums in float: off by at most 8 e (|world position| + |translation|), |.| being
// the sum of the components. A corner that clipping makes, at the near plane and at the sides, is rounded as much again each
// time: four times as much. What is stored is a convex combination of such corners, and the pixel's ray meets the moved plane at
// most error / cos(angle of incidence) away.
//
// Interpolation. Drivers set up planes u(x, y) = u0 + x du/dx + y du/dy for attributes u = a / w and 1 / w of what is left of the
// triangle in the picture or in a guard band of twice its size, cut into a fan, with
// du/dx = (du01 dy20 - du20 dy01) / area. Each operation rounds by e: with X = |x| + greatest |x_i|, Y alike, and
// k = (|dx01 dy20| + |dx20 dy01|) / |area|, the condition of the area, the result is off by at most
//   8 e (|u0| + ((|du01 dy20| + |du20 dy01|) X + (|du01 dx20| + |du20 dx01|) Y) (1 + k) / |area|),
// and a = u / w is off by (error of u + |a| error of 1/w) / (1/w).
//
// Normal maps. At the level above the footprint a pixel spans at most two texels, so a displacement of h along each axis moves uv
// by at most 4 h texels along each of two axes; bilinear filtering changes by at most 1 per texel, so a channel by 8 h, and by
// the change of the level, half the binary logarithm of the footprints' ratio; channels are doubled; three channels, made unit.
// Footprints are differences of two uv of four roundings each: 8 e |uv| over the difference is their relative error, 12 e |uv|
// that of the level.
#include "sweep/gbuffer_truth.hpp"

#include "ao/geometry_pass.hpp"
#include "ao/scene_check.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace gbuffer_test {

namespace {

constexpr double rounding = 0x1p-24;
constexpr double half_step = 1.0 / 512;

double total(const dvec3& v)
{
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

double cross2(const dvec2& a, const dvec2& b)
{
    return a.x * b.y - a.y * b.x;
}

// More than `margin` to the left of the way from a to b, as rows run downwards.
bool beyond(const dvec2& a, const dvec2& b, const dvec2& pixel, double margin)
{
    return cross2(b - a, pixel - a) < -margin * glm::length(b - a);
}

std::array<dvec2, 4> around(const dvec2& q, double h)
{
    return { q + dvec2(h, h), q + dvec2(h, -h), q + dvec2(-h, h), q + dvec2(-h, -h) };
}

// Keeps what has `inside` >= 0, a linear function of positions.
template <class Inside>
std::vector<corner> clip(const std::vector<corner>& polygon, Inside inside)
{
    std::vector<corner> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const corner& a = polygon[i];
        const corner& b = polygon[(i + 1) % polygon.size()];
        const double inside_a = inside(a.position);
        const double inside_b = inside(b.position);
        if (inside_a >= 0) {
            kept.push_back(a);
        }
        if ((inside_a < 0) != (inside_b < 0)) {
            const double t = inside_a / (inside_a - inside_b);
            kept.push_back({ a.position + (b.position - a.position) * t, a.normal + (b.normal - a.normal) * t,
                             a.uv + (b.uv - a.uv) * t, a.pixel });
        }
    }
    return kept;
}

} // namespace

lens::lens(const ao::gbuffer_camera& c, int width, int height, double near)
    : turn_(glm::mat3(c.view.to_glm())),
      move_(c.view.to_glm()[3]),
      xx_(static_cast<double>(c.projection.matrix[0][0])),
      yy_(static_cast<double>(c.projection.matrix[1][1])),
      xz_(static_cast<double>(c.projection.matrix[2][0])),
      yz_(static_cast<double>(c.projection.matrix[2][1])),
      width_(width),
      height_(height),
      near_(near)
{
}

double lens::most_translation() const
{
    return total(move_);
}

dvec2 lens::to_clip(const dvec3& p) const
{
    return { xx_ * p.x + xz_ * p.z, yy_ * p.y + yz_ * p.z };
}

dvec2 lens::to_pixel(const dvec3& p) const
{
    const dvec2 ndc = to_clip(p) / -p.z;
    return { (1 + ndc.x) / 2 * width_, (1 - ndc.y) / 2 * height_ };
}

dvec3 lens::ray(const dvec2& pixel) const
{
    const double x = 2 * pixel.x / width_ - 1;
    const double y = 1 - 2 * pixel.y / height_;
    return { (x + xz_) / xx_, (y + yz_) / yy_, -1 };
}

bool seen_triangle::set(const ao::scene& s, std::size_t object_index, std::size_t first_index, const lens& l)
{
    const ao::object& o = s.objects[object_index];
    const ao::mesh& m = s.meshes[static_cast<std::size_t>(o.mesh)];
    object = static_cast<std::uint32_t>(object_index);
    material_ = &s.materials[static_cast<std::size_t>(ao::geometry_material(s, o.material))];
    has_uvs_ = !m.uvs.empty();
    has_tangents_ = !m.tangents.empty();
    std::vector<corner> own(3);
    double most = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t v = m.indices[first_index + i];
        own[i].position = l.to_view(m.positions[v]);
        own[i].normal = l.turned(m.normals[v]);
        own[i].uv = has_uvs_ ? dvec2(m.uvs[v]) : dvec2(0.0);
        if (has_tangents_) {
            tangents_[i] = l.turned(glm::vec3(m.tangents[v]));
            handedness_ = static_cast<double>(m.tangents[v].w);
        }
        most = std::max(most, total(dvec3(m.positions[v])));
        own_[i] = own[i];
    }
    corner_error_ = 32 * rounding * (most + l.most_translation());
    const double determinant = glm::dot(own[0].position, glm::cross(own[1].position, own[2].position));
    plane_ = glm::cross(own[1].position - own[0].position, own[2].position - own[0].position);
    if (determinant == 0 || plane_ == dvec3(0.0)) {
        return false;
    }
    front_ = glm::dot(plane_, own[0].position) < 0;
    for (std::size_t i = 0; i < 3; ++i) {
        dual_[i] = glm::cross(own[(i + 1) % 3].position, own[(i + 2) % 3].position) / determinant;
    }
    corners = clip(own, [&](const dvec3& p) { return -p.z - l.near(); });
    if (corners.size() < 3) {
        return false;
    }
    low_ = dvec2(1e300);
    high_ = dvec2(-1e300);
    double area = 0;
    for (corner& c : corners) {
        c.pixel = l.to_pixel(c.position);
        low_ = glm::min(low_, c.pixel);
        high_ = glm::max(high_, c.pixel);
    }
    for (std::size_t i = 2; i < corners.size(); ++i) {
        area += cross2(corners[i - 1].pixel - corners[0].pixel, corners[i].pixel - corners[0].pixel);
    }
    if (area < 0) {
        std::reverse(corners.begin(), corners.end());
    }
    most_coordinate_ = std::max(std::max(std::abs(low_.x), std::abs(low_.y)), std::max(std::abs(high_.x), std::abs(high_.y)));
    displacement_ = half_step + 4 * rounding * std::min(most_coordinate_, 18432.0);
    return area != 0;
}

void seen_triangle::bound_rounding(const lens& l)
{
    for (const double guard : { 1.0, 2.0 }) {
        std::vector<corner> polygon = corners;
        for (int side = 0; side < 4 && !polygon.empty(); ++side) {
            polygon = clip(polygon, [&](const dvec3& p) {
                const dvec2 ndc = l.to_clip(p);
                const double along = side < 2 ? ndc.x : ndc.y;
                return -p.z * guard - (side % 2 == 0 ? along : -along);
            });
        }
        for (corner& c : polygon) {
            c.pixel = l.to_pixel(c.position);
        }
        add_fans(polygon);
    }
}

// Whichever corner a driver begins with when it cuts a polygon.
void seen_triangle::add_fans(const std::vector<corner>& polygon)
{
    const std::size_t n = polygon.size();
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 1; j + 1 < n; ++j) {
            add_piece({ &polygon[i], &polygon[(i + j) % n], &polygon[(i + j + 1) % n] });
        }
    }
}

void seen_triangle::add_piece(const std::array<const corner*, 3>& of)
{
    piece p{};
    const double area = std::abs(cross2(of[1]->pixel - of[0]->pixel, of[2]->pixel - of[0]->pixel));
    if (!(area > 0)) {
        return;
    }
    for (std::size_t first = 0; first < 3; ++first) {
        const corner& a = *of[first];
        const corner& b = *of[(first + 1) % 3];
        const corner& c = *of[(first + 2) % 3];
        p.pixels[first] = a.pixel;
        p.reach = glm::max(p.reach, glm::abs(a.pixel));
        const dvec2 d1 = glm::abs(b.pixel - a.pixel);
        const dvec2 d2 = glm::abs(c.pixel - a.pixel);
        const double condition = 1 + (d1.x * d2.y + d2.x * d1.y) / area;
        const auto bounds = [&](double at_a, double at_b, double at_c) {
            const double u0 = at_a / a.position.z;
            const double u1 = std::abs(at_b / b.position.z - u0);
            const double u2 = std::abs(at_c / c.position.z - u0);
            return dvec3(std::abs(u0), (u1 * d2.y + u2 * d1.y) * condition / area, (u1 * d2.x + u2 * d1.x) * condition / area);
        };
        dvec3 position(0.0);
        dvec3 normal(0.0);
        for (int axis = 0; axis < 3; ++axis) {
            position += bounds(a.position[axis], b.position[axis], c.position[axis]);
            normal += bounds(a.normal[axis], b.normal[axis], c.normal[axis]);
        }
        p.position = glm::max(p.position, position);
        p.normal = glm::max(p.normal, normal);
        p.weight = glm::max(p.weight, bounds(1, 1, 1));
    }
    pieces_.push_back(p);
}

bool seen_triangle::covers(const dvec2& pixel, double margin) const
{
    if (pixel.x < low_.x - margin || pixel.x > high_.x + margin || pixel.y < low_.y - margin || pixel.y > high_.y + margin) {
        return false;
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (beyond(corners[i].pixel, corners[(i + 1) % corners.size()].pixel, pixel, margin)) {
            return false;
        }
    }
    return true;
}

dvec3 seen_triangle::weights(const dvec3& direction) const
{
    return { glm::dot(dual_[0], direction), glm::dot(dual_[1], direction), glm::dot(dual_[2], direction) };
}

bool seen_triangle::uv_at(const dvec2& pixel, const lens& l, dvec2& uv) const
{
    const dvec3 w = weights(l.ray(pixel));
    const double sum = w.x + w.y + w.z;
    uv = (own_[0].uv * w.x + own_[1].uv * w.y + own_[2].uv * w.z) / sum;
    return sum > 0;
}

// Within the pixel's block of 2x2.
double seen_triangle::footprint(const dvec2& pixel, const lens& l) const
{
    const auto column = static_cast<int>(std::floor(pixel.x));
    const auto row = static_cast<int>(std::floor(pixel.y));
    dvec2 here;
    dvec2 x;
    dvec2 y;
    if (!uv_at(pixel, l, here) || !uv_at(pixel + dvec2((column ^ 1) - column, 0), l, x) ||
        !uv_at(pixel + dvec2(0, (row ^ 1) - row), l, y)) {
        return 1e30;
    }
    const dvec2 along_x = x - here;
    const dvec2 along_y = y - here;
    const double repeat = static_cast<double>(std::max(std::abs(material_->repeat.x), std::abs(material_->repeat.y)));
    return std::max(glm::dot(along_x, along_x), glm::dot(along_y, along_y)) * repeat * repeat;
}

bool seen_triangle::at(const dvec2& pixel, const lens& l, const ao::texel_heap& heap, const dvec3& about, surface_point& to) const
{
    struct interpolated {
        dvec3 position;
        dvec3 normal;
    };
    const auto look = [&](const dvec2& q, interpolated& p) {
        const dvec3 ray = l.ray(q);
        const dvec3 w = weights(ray);
        const double sum = w.x + w.y + w.z; // 1 / depth
        p.position = ray / sum;
        p.normal = (own_[0].normal * w.x + own_[1].normal * w.y + own_[2].normal * w.z) / sum;
        return sum > 0;
    };
    interpolated here;
    if (!look(pixel, here)) {
        return false;
    }
    to.position = here.position;
    // What is stored is a convex combination of the corners, whatever the plane's gradient.
    double most_moved = 0;
    double most_turned = 0;
    for (const corner& c : corners) {
        most_moved = std::max(most_moved, glm::length(c.position - here.position));
        most_turned = std::max(most_turned, glm::length(c.normal - here.normal));
    }
    if (glm::length(here.position - about) > 1.001 * most_moved) {
        return false;
    }
    double moved = 0;
    double turned = 0;
    for (const dvec2& q : around(pixel, displacement_)) {
        interpolated there;
        const bool before_horizon = look(q, there);
        moved = std::max(moved, before_horizon ? glm::length(there.position - here.position) : most_moved);
        turned = std::max(turned, before_horizon ? glm::length(there.normal - here.normal) : most_turned);
    }
    moved = std::min(moved, most_moved);
    turned = std::min(turned, most_turned);
    const double distance = glm::length(here.position);
    const double cosine = std::abs(glm::dot(plane_, here.position)) / (glm::length(plane_) * distance);
    const double depth = -here.position.z;
    const double length = glm::length(here.normal);
    double position = 0;
    double normal = 0;
    const double margin = std::sqrt(2.0) * displacement_;
    for (const piece& p : pieces_) {
        if (beyond(p.pixels[0], p.pixels[1], pixel, margin) || beyond(p.pixels[1], p.pixels[2], pixel, margin) ||
            beyond(p.pixels[2], p.pixels[0], pixel, margin)) {
            continue;
        }
        const dvec3 reach(1, pixel.x + p.reach.x, pixel.y + p.reach.y);
        const auto rounded = [&](const dvec3& of, double value) {
            return 8 * rounding * (glm::dot(of, reach) + value * glm::dot(p.weight, reach)) * depth;
        };
        position = std::max(position, rounded(p.position, distance));
        normal = std::max(normal, rounded(p.normal, length));
    }
    to.position_bound = moved + position + corner_error_ * (1 + 1 / cosine);

    to.normal = here.normal / length;
    to.normal_bound = 2 * (turned + normal) / length + 16 * rounding;
    if (material_->normal_map != ao::no_texture) {
        dvec2 uv;
        static_cast<void>(uv_at(pixel, l, uv));
        const double f = footprint(pixel, l);
        const dvec3 w = weights(l.ray(pixel));
        const dvec3 tangent = tangents_[0] * w.x + tangents_[1] * w.y + tangents_[2] * w.z;
        const dvec3 texel(ao::sample<double>(heap, material_->normal_map, uv * dvec2(material_->repeat), f));
        const double green = material_->normal_green_down ? -1 : 1;
        to.normal = ao::math<double>::ao_mapped_normal(here.normal, tangent, handedness_, texel, green);
        const dvec2 scaled = glm::abs(uv * dvec2(material_->repeat));
        double level = 12 * rounding * (scaled.x + scaled.y) / std::sqrt(f);
        for (const dvec2& q : around(pixel, displacement_)) {
            level = std::max(level, std::abs(std::log2(footprint(q, l) / f)) / 2);
        }
        const double channel = 8 * displacement_ + level;
        to.normal_bound += 2 * std::sqrt(3.0) * 2 * channel / std::max(0.25, glm::length(texel * 2.0 - 1.0));
    }
    if (!front_) {
        to.normal = -to.normal;
    }
    return true;
}

double seen_triangle::distance_to_edge(const dvec2& pixel) const
{
    double least = 1e300;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const dvec2& a = corners[i].pixel;
        const dvec2 along = corners[(i + 1) % corners.size()].pixel - a;
        const double square = glm::dot(along, along);
        const double t = square > 0 ? std::clamp(glm::dot(pixel - a, along) / square, 0.0, 1.0) : 0.0;
        least = std::min(least, glm::length(pixel - (a + along * t)));
    }
    return least;
}

double seen_triangle::distance_to_cut(const seen_triangle& other, const dvec2& pixel, const lens& l) const
{
    const auto difference = [&](const dvec2& q) {
        const dvec3 ray = l.ray(q);
        const dvec3 w = weights(ray) - other.weights(ray);
        return w.x + w.y + w.z;
    };
    const double here = difference(pixel);
    const double slope = glm::length(dvec2(difference(pixel + dvec2(1, 0)) - here, difference(pixel + dvec2(0, 1)) - here));
    return slope > 0 ? std::abs(here) / slope : 1e300;
}

bool seen_triangle::alpha_edge(const dvec2& pixel, const lens& l, const ao::texel_heap& heap, double doubt) const
{
    if (material_->alpha_map == ao::no_texture || !has_uvs_ || !covers(pixel, 0.5)) {
        return false;
    }
    const double f = footprint(pixel, l);
    double low = 1;
    double high = 0;
    for (int i = 0; i < 9; ++i) {
        dvec2 uv;
        if (!uv_at(pixel + dvec2(i % 3 - 1, i / 3 - 1) * 0.5, l, uv)) {
            continue;
        }
        const auto texel = ao::sample<double>(heap, material_->alpha_map, uv * dvec2(material_->repeat), f);
        const double alpha = material_->alpha_from_red ? texel.x : texel.w;
        low = std::min(low, alpha);
        high = std::max(high, alpha);
    }
    const auto cutoff = static_cast<double>(material_->alpha_cutoff);
    return low - doubt < cutoff && high + doubt >= cutoff;
}

std::vector<seen_triangle> seen_triangles(const ao::scene& s, const lens& l, int width, int height)
{
    std::vector<seen_triangle> seen;
    for (std::size_t i = 0; i < s.objects.size(); ++i) {
        const ao::mesh& m = s.meshes[static_cast<std::size_t>(s.objects[i].mesh)];
        for (std::size_t first = 0; first + 3 <= m.indices.size(); first += 3) {
            seen_triangle t;
            if (t.set(s, i, first, l) && t.high().x > -1 && t.high().y > -1 && t.low().x < width + 1 && t.low().y < height + 1) {
                t.bound_rounding(l);
                seen.push_back(t);
            }
        }
    }
    return seen;
}

} // namespace gbuffer_test
