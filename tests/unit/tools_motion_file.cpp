// Files of motion: what they mean, and every way in which one can be wrong.
#include "scene/courtyard.hpp"
#include "scene/error.hpp"
#include "scene/motion.hpp"
#include "tools_support.hpp"

#include <catch2/catch.hpp>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

using namespace ao::tools;
using glm::dvec3;

namespace {

scene named_boxes()
{
    scene s;
    mesh_builder m(s);
    for (const char* name : { "a", "b", "twice", "twice" }) {
        m.begin(name, "any");
        m.box({ 1.0f, 2.0f, 3.0f }, { 3.0f, 4.0f, 5.0f });
    }
    m.begin("empty", "any");
    return s;
}

camera start_camera()
{
    camera c;
    c.eye = { 1.0f, 2.0f, 3.0f };
    c.fov = 40.0f;
    return c;
}

motion parsed(const std::string& text)
{
    static const scene s = named_boxes();
    return parse_motion("m.json", text, { s, start_camera() });
}

motion of_object(const std::string& keys, const std::string& more = "")
{
    return parsed("{ " + more + R"( "objects": { "a": { "keys": [)" + keys + "] } } }");
}

dvec3 moved(const motion& m, int frame, const dvec3& p)
{
    return dvec3(m.transform(0, frame) * glm::dvec4(p, 1.0));
}

std::string error_of(const std::string& text)
{
    try {
        static_cast<void>(parsed(text));
    } catch (const error& e) {
        return e.what();
    }
    return "no error";
}

} // namespace

TEST_CASE("the documented file of motion moves the courtyard", "[tools][motion_file]")
{
    const scene s = courtyard(true);
    const scratch_directory d;
    const motion m = choose_motion(d.file("m.json", documented_example("motion")), { s, courtyard_camera(), true });
    CHECK(m.moves_camera());
    CHECK(m.moves_objects());
    CHECK(m.camera_at(30).eye.x == Approx(3.4f));
    CHECK(m.camera_at(89).yaw == Approx(-12.0f));
    CHECK(m.camera_at(90).yaw == Approx(31.0f));
    CHECK(m.camera_at(90).fov == Approx(58.0f));
    for (int f = 0; f < 400; ++f)
        CHECK(m.cut_at(f) == (f % 120 == 90));
    const auto box =
        static_cast<std::size_t>(std::find(s.object_names.begin(), s.object_names.end(), "box") - s.object_names.begin());
    CHECK(m.transform(box, 30)[3].x == Approx(0.75));
    CHECK(m.transform(box, 150)[3].x == Approx(0.75));
    CHECK_FALSE(m.moves(box - 1));
}

TEST_CASE("between keyframes of the camera all is linear, yaw the shorter way", "[tools][motion_file]")
{
    const motion m = parsed(R"({ "camera": [
      { "frame": 10, "eye": [0, 0, 0], "yaw": 350, "pitch": -10 },
      { "frame": 20, "eye": [10, 20, -40], "yaw": 10, "pitch": 30, "fov": 60 },
      { "frame": 24, "eye": [10, 20, -40], "yaw": -90, "pitch": 30 } ] })");
    for (int f = 10; f <= 20; ++f) {
        const camera c = m.camera_at(f);
        const double share = (f - 10) / 10.0;
        CHECK(glm::length(dvec3(c.eye) - share * dvec3(10, 20, -40)) < 1e-5);
        CHECK(std::remainder(static_cast<double>(c.yaw) - (350.0 + 20.0 * share), 360.0) == Approx(0.0).margin(1e-4));
        CHECK(static_cast<double>(c.pitch) == Approx(-10.0 + 40.0 * share).margin(1e-5));
        CHECK(static_cast<double>(c.fov) == Approx(40.0 + 20.0 * share));
    }
    CHECK(m.camera_at(0).yaw == 350.0f);
    CHECK(m.camera_at(22).yaw == Approx(-40.0f));
    CHECK(m.camera_at(1000).yaw == -90.0f);
    CHECK(m.camera_at(1000).fov == 60.0f);
    CHECK_FALSE(m.moves_objects());
}

TEST_CASE("a cut holds the view until it comes, and a loop starts again", "[tools][motion_file]")
{
    const std::string keys = R"("camera": [
      { "frame": 0, "eye": [0, 0, 0], "yaw": 0, "pitch": 0 },
      { "frame": 4, "eye": [4, 0, 0], "yaw": 0, "pitch": 0 },
      { "frame": 8, "eye": [9, 0, 0], "yaw": 0, "pitch": 0, "cut": true },
      { "frame": 10, "eye": [11, 0, 0], "yaw": 0, "pitch": 0, "cut": false } ])";
    const motion once = parsed("{" + keys + "}"), again = parsed("{" + keys + R"(, "loop": 12 })");
    const float expected[] = { 0, 1, 2, 3, 4, 4, 4, 4, 9, 10, 11, 11 };
    for (int f = 0; f < 36; ++f) {
        INFO("frame " << f);
        CHECK(once.camera_at(f).eye.x == Approx(expected[std::min(f, 11)]));
        CHECK(again.camera_at(f).eye.x == Approx(expected[f % 12]));
        CHECK(once.cut_at(f) == (f == 8));
        CHECK(again.cut_at(f) == (f % 12 == 8));
    }
    const motion begins = parsed(R"({ "loop": 5, "camera": [
      { "frame": 0, "eye": [0, 0, 0], "yaw": 0, "pitch": 0, "cut": true },
      { "frame": 5, "eye": [4, 0, 0], "yaw": 0, "pitch": 0 } ] })");
    CHECK_FALSE(begins.cut_at(0)); // there is nothing to forget
    CHECK(begins.cut_at(5));
    CHECK(begins.cut_at(10));
}

TEST_CASE("one keyframe is a camera that stands; without any it is the start camera", "[tools][motion_file]")
{
    const motion one = parsed(R"({ "camera": [{ "frame": 7, "eye": [5, 0, 0], "yaw": 0, "pitch": 0 }] })");
    CHECK_FALSE(one.moves_camera());
    CHECK(one.camera_at(0).eye.x == 5.0f);
    CHECK(one.camera_at(0).fov == 40.0f);
    const motion none = of_object(R"({ "frame": 0 })");
    CHECK_FALSE(none.moves_camera());
    CHECK(none.camera_at(3).eye == start_camera().eye);
}

TEST_CASE("objects are scaled and turned about their middle, or the pivot, and then carried away", "[tools][motion_file]")
{
    const dvec3 middle(2, 3, 4), p(3, 4, 5);
    const motion slide = of_object(R"({ "frame": 0 }, { "frame": 10, "translate": [10, 0, -5] })");
    CHECK(glm::length(moved(slide, 4, p) - (p + dvec3(4, 0, -2))) < 1e-12);
    const motion grow = of_object(R"({ "frame": 0, "scale": 1 }, { "frame": 10, "scale": [3, 1, 2] })");
    CHECK(glm::length(moved(grow, 5, p) - (middle + dvec3(2, 1, 1.5))) < 1e-12);
    const motion turn = of_object(R"({ "frame": 0, "rotate": { "axis": [0, 2, 0], "degrees": 0 } },
                                     { "frame": 10, "rotate": { "axis": [0, 2, 0], "degrees": 900 } })");
    CHECK(glm::length(moved(turn, 1, p) - (middle + dvec3(1, 1, -1))) < 1e-12); // 90 degrees: +z to +x to -z
    CHECK(glm::length(moved(turn, 6, p) - (middle + dvec3(-1, 1, -1))) < 1e-12);
    CHECK(glm::length(moved(turn, 4, p) - p) < 1e-12);
    const motion starts = of_object(R"({ "frame": 0 }, { "frame": 4, "rotate": { "axis": [0, 1, 0], "degrees": 360 } })");
    CHECK(glm::length(moved(starts, 1, p) - (middle + dvec3(1, 1, -1))) < 1e-12);
    const motion hinge = parsed(R"({ "objects": { "a": { "pivot": [1, 0, 3], "keys": [
      { "frame": 0 }, { "frame": 2, "rotate": { "axis": [0, 1, 0], "degrees": 180 }, "translate": [0, 7, 0] }] } } })");
    CHECK(glm::length(moved(hinge, 0, p) - p) < 1e-12);
    CHECK(glm::length(moved(hinge, 2, p) - dvec3(-1, 11, 1)) < 1e-12);
    CHECK(glm::length(moved(hinge, 2, dvec3(1, 0, 3)) - dvec3(1, 7, 3)) < 1e-12);
}

TEST_CASE("between different axes an object turns the shorter way", "[tools][motion_file]")
{
    const motion m = of_object(R"({ "frame": 0, "rotate": { "axis": [0, 1, 0], "degrees": 90 } },
                                  { "frame": 10, "rotate": { "axis": [0, -1, 0], "degrees": 630 } })");
    // 90 degrees and -630 + 720 = 90: the same.
    for (const int f : { 0, 3, 10 })
        CHECK(glm::length(moved(m, f, { 3, 4, 5 }) - dvec3(3, 4, 3)) < 1e-9);
    const motion half = of_object(R"({ "frame": 0, "rotate": { "axis": [1, 0, 0], "degrees": 90 } },
                                     { "frame": 2, "rotate": { "axis": [0, 0, 1], "degrees": 90 } })");
    // The rotation by which the second follows from the first is by 120 degrees; half of it is 60 from either.
    const glm::dmat3 first(half.transform(0, 0)), middle(half.transform(0, 1)), last(half.transform(0, 2));
    const auto degrees = [](const glm::dmat3& from, const glm::dmat3& to) {
        const glm::dmat3 r = to * glm::transpose(from);
        return glm::degrees(std::acos((r[0][0] + r[1][1] + r[2][2] - 1.0) / 2.0));
    };
    CHECK(degrees(first, last) == Approx(120.0));
    CHECK(degrees(first, middle) == Approx(60.0));
    CHECK(degrees(middle, last) == Approx(60.0));
}

TEST_CASE("what is wrong in a file of motion is told in one line", "[tools][motion_file]")
{
    using Catch::Matchers::Contains;
    struct wrong {
        const char* text;
        const char* reason;
    };
    const std::string view = R"({ "frame": 0, "eye": [0, 0, 0], "yaw": 0, "pitch": 0 })";
    for (const wrong& w : {
             wrong{ "", "m.json:1:" },
             { "[]", "m.json:1:1: /: must be an object" },
             { "{}", "m.json:1:1: /: needs a camera or objects" },
             { R"({ "objects": {}, "speed": 1 })", "m.json:1:27: /speed: unknown member" },
             { R"({ "camera": {} })", "/camera: must be an array of keyframes" },
             { R"({ "camera": [] })", "m.json:1:13: /camera: must have a keyframe" },
             { R"({ "camera": [3] })", "/camera/0: must be a keyframe" },
             { R"({ "camera": [{ "frame": 0 }] })", "/camera/0: has no member 'eye'" },
             { R"({ "camera": [{ "eye": [0, 0, 0], "yaw": 0, "pitch": 0 }] })", "has no member 'frame'" },
             { R"({ "camera": [{ "frame": -1, "eye": [0, 0, 0], "yaw": 0, "pitch": 0 }] })",
               "/camera/0/frame: must be 0 to 1e+06" },
             { R"({ "camera": [{ "frame": 0.5, "eye": [0, 0, 0], "yaw": 0, "pitch": 0 }] })", "must be a whole number" },
             { R"({ "camera": [{ "frame": 0, "eye": [0, 0], "yaw": 0, "pitch": 0 }] })",
               "eye: must be an array of 3 numbers, has 2" },
             { R"({ "camera": [{ "frame": 0, "eye": [0, 2e18, 0], "yaw": 0, "pitch": 0 }] })", "eye: must not be beyond 1e18" },
             { R"({ "camera": [{ "frame": 0, "eye": [0, -2e18, 0], "yaw": 0, "pitch": 0 }] })",
               "/camera/0/eye/1: must be -1e+18" },
             { R"({ "camera": [{ "frame": 0, "eye": [0, NaN, 0], "yaw": 0, "pitch": 0 }] })", "m.json:1:" },
             { R"({ "camera": [{ "frame": 0, "eye": [0, 1e999, 0], "yaw": 0, "pitch": 0 }] })", "m.json:1:" },
             { R"({ "camera": [{ "frame": 0, "eye": [0, 0, 0], "yaw": 0, "pitch": 91 }] })", "pitch: must be -90 to 90, is 91" },
             { R"({ "camera": [{ "frame": 0, "eye": [0, 0, 0], "yaw": 0, "pitch": 0, "fov": 0 }] })", "fov: must be 0.1 to 179" },
             { R"({ "camera": [{ "frame": 0, "eye": [0, 0, 0], "yaw": 0, "pitch": 0, "cut": 1 }] })",
               "/camera/0/cut: must be true or false, is a number" },
             { R"({ "objects": [] })", "/objects: must be an object by name" },
             { R"({ "objects": { "c": { "keys": [{ "frame": 0 }] } } })", "/objects/c: the scene has no object named 'c'" },
             { R"({ "objects": { "twice": { "keys": [{ "frame": 0 }] } } })", "the scene has 2 objects named 'twice'" },
             { R"({ "objects": { "empty": { "keys": [{ "frame": 0 }] } } })", "the object has no triangles" },
             { R"({ "objects": { "a": {} } })", "/objects/a: has no member 'keys'" },
             { R"({ "objects": { "a": { "keys": [] } } })", "/objects/a/keys: must have a keyframe" },
             { R"({ "objects": { "a": { "keys": [{ "frame": 3 }, { "frame": 3 }] } } })",
               "/objects/a/keys/1/frame: must be after frame 3, is 3" },
             { R"({ "objects": { "a": { "keys": [{ "frame": 0, "rotate": { "degrees": 3 } }] } } })", "has no member 'axis'" },
             { R"({ "objects": { "a": { "keys": [{ "frame": 0, "rotate": { "axis": [0, 0, 0], "degrees": 3 } }] } } })",
               "rotate/axis: must not be zero" },
             { R"({ "objects": { "a": { "keys": [{ "frame": 0, "scale": 0 }] } } })", "scale: must be 1e-06 to 1e+06, is 0" },
             { R"({ "objects": { "a": { "keys": [{ "frame": 0, "scale": [1, -1, 1] }] } } })", "scale/1: must be 1e-06" },
             { R"({ "objects": { "a": { "keys": [{ "frame": 0, "scale": [1, 1e7, 1] }] } } })",
               "scale: must not be more than 1e6" },
             { R"({ "objects": { "a": { "keys": [{ "frame": 0, "spin": 1 }] } } })", "spin: unknown member" },
             { R"({ "loop": 0, "objects": { "a": { "keys": [{ "frame": 0 }] } } })", "/loop: must be 1 to" },
             { R"({ "loop": 4, "objects": { "a": { "keys": [{ "frame": 0 }, { "frame": 5 }] } } })",
               "/loop: must not be before the last keyframe, 5, is 4" },
         }) {
        INFO(w.text);
        const std::string told = error_of(w.text);
        CHECK_THAT(told, Contains(w.reason));
        CHECK_THAT(told, Catch::Matchers::StartsWith("m.json:"));
        CHECK(told.find('\n') == std::string::npos);
    }
    CHECK(error_of("{ \"camera\": [" + view + "] }") == "no error");
    const scene s = named_boxes();
    CHECK_THROWS_AS(choose_motion("/nowhere/m.json", { s, start_camera() }), error);
}
