// A backend under test with everything it can run, and the places where a fault can be put into it.
#pragma once

#include "host/bake_runner.hpp"
#include "host/runner.hpp"
#include "host/scene_runner.hpp"
#include "host/temporal_runner.hpp"

#include "ao/picture.hpp"
#include "ao/plan.hpp"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace stability {

// A frame: what is seen, and how it is stored and looked at.
struct shot {
    ao::settings settings;
    ao::facts facts;
    ao::camera camera;
    std::vector<float> depth;       // eye depth, 0: background
    std::vector<glm::vec3> normals; // view space
};

struct stored_shot {
    ao::picture depth;
    ao::picture normal; // empty where facts::normals is from_depth
};

stored_shot store(const shot& s);

using evaluation =
    std::function<void(int function, std::span<const glm::vec4> a, std::span<const glm::vec4> b, std::span<glm::vec4> out)>;
using frame_function = std::function<ao::result<ao::picture>(const shot&, const stored_shot&)>;

class subject {
public:
    enum class kind { cpu_scalar, cpu_lanes, gl, vk };

    subject(kind which, bool more) : thorough(more), kind_(which) {}

    const char* name() const;
    // Visibilities in memory order; NaN everywhere where the backend refuses.
    std::vector<float> frame(const shot& s);
    // As stored, after `poison` has been at the pictures.
    std::vector<float> frame(const shot& s, const stored_shot& pictures);
    std::vector<glm::vec4> evaluate(int function, const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b);
    // Made on first use; null where this machine has none.
    ao::host::runner* passes();
    ao::host::temporal_runner* temporal();
    ao::host::scene_runner* scene();
    ao::host::bake_runner* baker();

    // The long form: more inputs.
    bool thorough;

    // Faults. None in a subject that is not spoilt; `faulty` is for rows that build their fault in themselves.
    bool faulty = false;
    evaluation evaluate_instead;
    frame_function frame_instead;
    std::function<void(shot&)> change_shot;
    std::function<void(std::vector<float>&)> change_visibility;
    std::function<void(ao::temporal_settings&)> change_temporal;
    void heal();

private:
    kind kind_;
    std::shared_ptr<ao::host::runner> passes_;
    std::shared_ptr<ao::host::temporal_runner> temporal_;
    std::shared_ptr<ao::host::scene_runner> scene_;
    std::shared_ptr<ao::host::bake_runner> baker_;
    std::optional<std::vector<std::byte>> prepared_;
};

// The subjects of this build.
std::vector<subject> all_subjects(bool thorough);

} // namespace stability
