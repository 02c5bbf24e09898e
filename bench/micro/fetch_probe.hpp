// What a bare texelFetch of R32F costs on a Vulkan device.
#pragma once

#include "host/vulkan_device.hpp"

#include "ao/picture.hpp"

#include <memory>

namespace ao::bench {

// A compute shader that does `fetches` fetches per pixel of a picture, and nothing else that takes time.
class fetch_probe {
public:
    static host::result<std::unique_ptr<fetch_probe>> create(host::vulkan_device& device, const picture& r32f, int fetches);
    virtual ~fetch_probe() = default;
    // Milliseconds of one dispatch, by the device's clock.
    virtual host::result<double> run() = 0;
    // What the last one wrote: sums.
    virtual host::result<picture> download() = 0;
};

// The same sums computed here, for the check before the clock starts.
picture expected_sums(const picture& r32f, int fetches);

} // namespace ao::bench
