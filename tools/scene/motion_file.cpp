#include "json_file.hpp"
#include "motion.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ao::tools {
namespace {

constexpr double farthest = 1.0e18; // largest_coordinate
constexpr double last_frame = 1.0e6;

struct camera_key {
    int frame;
    camera at;
    bool cut;
};

struct object_key {
    int frame;
    glm::dvec3 translate{ 0.0 };
    glm::dvec3 axis{ 0.0 }; // zero: not turned
    double degrees = 0.0;
    glm::dvec3 scale{ 1.0 };
};

int whole(const json_value& value, double low)
{
    const float n = value.number(low, last_frame);
    if (n != std::floor(n))
        value.fail("must be a whole number");
    return static_cast<int>(n);
}

glm::dvec3 vector(const json_value& value)
{
    const std::vector<float> v = value.numbers(3, -farthest);
    if (static_cast<double>(*std::max_element(v.begin(), v.end())) > farthest)
        value.fail("must not be beyond 1e18");
    return { v[0], v[1], v[2] };
}

// An array of keyframes, each read by `read` after its frame.
template <class Key, class Read>
std::vector<Key> keyframes(const json_value& list, const Read& read)
{
    if (!list.is_array())
        list.fail("must be an array of keyframes");
    std::vector<Key> keys;
    for (const json_value& value : list.children()) {
        if (!value.is_object())
            value.fail("must be a keyframe");
        const json_value frame = value.at("frame");
        const int number = whole(frame, 0.0);
        if (!keys.empty() && number <= keys.back().frame)
            frame.fail("must be after frame " + std::to_string(keys.back().frame) + ", is " + std::to_string(number));
        Key key = read(value, keys);
        key.frame = number;
        keys.push_back(key);
    }
    if (keys.empty())
        list.fail("must have a keyframe");
    return keys;
}

std::vector<camera_key> read_camera(const json_value& list, const camera& start)
{
    return keyframes<camera_key>(list, [&](const json_value& value, const std::vector<camera_key>& before) {
        value.allow({ "frame", "eye", "yaw", "pitch", "fov", "cut" });
        camera_key key{};
        key.at.eye = glm::vec3(vector(value.at("eye")));
        key.at.yaw = value.at("yaw").number(-36000.0, 36000.0);
        key.at.pitch = value.at("pitch").number(-90.0, 90.0);
        key.at.fov = before.empty() ? start.fov : before.back().at.fov;
        if (const auto fov = value.find("fov"))
            key.at.fov = fov->number(0.1, 179.0);
        if (const auto cut = value.find("cut"))
            key.cut = cut->boolean();
        return key;
    });
}

std::vector<object_key> read_object(const json_value& list)
{
    return keyframes<object_key>(list, [](const json_value& value, const std::vector<object_key>&) {
        value.allow({ "frame", "translate", "rotate", "scale" });
        object_key key{};
        if (const auto translate = value.find("translate"))
            key.translate = vector(*translate);
        if (const auto rotate = value.find("rotate")) {
            rotate->allow({ "axis", "degrees" });
            const json_value axis = rotate->at("axis");
            key.axis = vector(axis);
            if (!(glm::length(key.axis) > 0.0))
                axis.fail("must not be zero");
            key.axis = glm::normalize(key.axis);
            key.degrees = static_cast<double>(rotate->at("degrees").number(-1.0e6, 1.0e6));
        }
        if (const auto scale = value.find("scale")) {
            constexpr double least = 1.0e-6, most = 1.0e6;
            std::vector<float> v(3, scale->is_array() ? 1.0f : 0.0f);
            if (scale->is_array())
                v = scale->numbers(3, least);
            else
                v.assign(3, scale->number(least, most));
            if (static_cast<double>(*std::max_element(v.begin(), v.end())) > most)
                scale->fail("must not be more than 1e6");
            key.scale = { v[0], v[1], v[2] };
        }
        return key;
    });
}

// The keyframes on either side of a frame, and how far it is from one to the other.
struct between {
    std::size_t first;
    std::size_t second;
    double share; // 0..1
};

template <class Key>
between find(const std::vector<Key>& keys, int frame)
{
    std::size_t next = 0;
    while (next < keys.size() && keys[next].frame <= frame)
        ++next;
    if (next == 0 || next == keys.size()) {
        const std::size_t end = next == 0 ? 0 : next - 1;
        return { end, end, 0.0 };
    }
    const int from = keys[next - 1].frame, to = keys[next].frame;
    return { next - 1, next, static_cast<double>(frame - from) / static_cast<double>(to - from) };
}

float mixed(float a, float b, double share)
{
    return static_cast<float>(static_cast<double>(a) + (static_cast<double>(b) - static_cast<double>(a)) * share);
}

camera interpolate(const std::vector<camera_key>& keys, int frame)
{
    const between at = find(keys, frame);
    const camera &a = keys[at.first].at, &b = keys[at.second].at;
    if (at.first == at.second || keys[at.second].cut)
        return a;
    camera c;
    c.eye = glm::vec3(glm::mix(glm::dvec3(a.eye), glm::dvec3(b.eye), at.share));
    const double turn = std::remainder(static_cast<double>(b.yaw) - static_cast<double>(a.yaw), 360.0);
    c.yaw = static_cast<float>(static_cast<double>(a.yaw) + turn * at.share);
    c.pitch = mixed(a.pitch, b.pitch, at.share);
    c.fov = mixed(a.fov, b.fov, at.share);
    return c;
}

glm::dmat4 rotation(const object_key& a, const object_key& b, double share)
{
    const bool a_turned = a.axis != glm::dvec3(0.0), b_turned = b.axis != glm::dvec3(0.0);
    if (!a_turned && !b_turned)
        return glm::dmat4(1.0);
    const glm::dvec3 axis = a_turned ? a.axis : b.axis;
    if (!a_turned || !b_turned || a.axis == b.axis) // of which there may be several turns
        return glm::rotate(glm::dmat4(1.0), glm::radians(glm::mix(a.degrees, b.degrees, share)), axis);
    const glm::dquat from = glm::angleAxis(glm::radians(a.degrees), a.axis), to = glm::angleAxis(glm::radians(b.degrees), b.axis);
    return glm::mat4_cast(glm::normalize(glm::slerp(from, to, share)));
}

glm::dmat4 interpolate(const std::vector<object_key>& keys, const glm::dvec3& pivot, int frame)
{
    const between at = find(keys, frame);
    const object_key &a = keys[at.first], &b = keys[at.second];
    const glm::dmat4 there = glm::translate(glm::dmat4(1.0), pivot + glm::mix(a.translate, b.translate, at.share));
    const glm::dmat4 turned = there * rotation(a, b, at.share);
    return glm::translate(glm::scale(turned, glm::mix(a.scale, b.scale, at.share)), -pivot);
}

std::size_t object_named(const scene& s, const json_value& entry)
{
    const std::string name = entry.key();
    const auto count = std::count(s.object_names.begin(), s.object_names.end(), name);
    if (count == 0)
        entry.fail("the scene has no object named " + in_quotes(name));
    if (count > 1)
        entry.fail("the scene has " + std::to_string(count) + " objects named " + in_quotes(name));
    return static_cast<std::size_t>(std::find(s.object_names.begin(), s.object_names.end(), name) - s.object_names.begin());
}

} // namespace

motion parse_motion(const std::string& name, const std::string& text, const motion_stage& s)
{
    const json_file file(name, text);
    const json_value root = file.root();
    root.allow({ "loop", "camera", "objects" });
    const auto camera_part = root.find("camera"), objects_part = root.find("objects"), loop_part = root.find("loop");
    if (!camera_part && !objects_part)
        root.fail("needs a camera or objects");
    int last = 0;

    std::vector<camera_key> views;
    if (camera_part) {
        views = read_camera(*camera_part, s.start);
        last = views.back().frame;
    }
    struct object_keys {
        std::size_t object;
        glm::dvec3 pivot;
        std::vector<object_key> keys;
    };
    std::vector<object_keys> read;
    if (objects_part) {
        if (!objects_part->is_object())
            objects_part->fail("must be an object by name of objects");
        for (const json_value& entry : objects_part->children()) {
            const std::size_t object = object_named(s.rest, entry);
            entry.allow({ "pivot", "keys" });
            const std::optional<bounds> b = bounds_of(s.rest, object);
            if (!b)
                entry.fail("the object has no triangles");
            const auto pivot = entry.find("pivot");
            read.push_back({ object, pivot ? vector(*pivot) : (glm::dvec3(b->low) + glm::dvec3(b->high)) / 2.0,
                             read_object(entry.at("keys")) });
            last = std::max(last, read.back().keys.back().frame);
        }
    }
    int loop = 0;
    if (loop_part) {
        loop = whole(*loop_part, 1.0);
        if (loop < last)
            loop_part->fail("must not be before the last keyframe, " + std::to_string(last) + ", is " + std::to_string(loop));
    }

    const auto within = [loop](int frame) { return loop > 0 ? frame % loop : frame; };
    std::vector<motion::moving_object> objects;
    for (object_keys& each : read)
        objects.push_back({ each.object, [within, keys = std::move(each.keys), pivot = each.pivot](int frame) {
                               return interpolate(keys, pivot, within(frame));
                           } });
    if (views.size() < 2)
        return motion(views.empty() ? s.start : views.front().at, std::move(objects));
    const auto cuts = [within, views](int frame) {
        const int there = within(frame);
        return std::any_of(views.begin(), views.end(), [&](const camera_key& k) { return k.cut && k.frame == there; });
    };
    return { [within, views](int frame) { return interpolate(views, within(frame)); }, std::move(objects), cuts };
}

} // namespace ao::tools
