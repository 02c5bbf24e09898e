#include "host/pixel_format.hpp"

namespace ao::host {
bool is_depth(pixel_format format)
{
    return format == pixel_format::d32f || format == pixel_format::d24;
}

const char* name(pixel_format format)
{
    switch (format) {
    case pixel_format::r8:
        return "r8";
    case pixel_format::r32f:
        return "r32f";
    case pixel_format::rg32f:
        return "rg32f";
    case pixel_format::rgba16f:
        return "rgba16f";
    case pixel_format::rgba32f:
        return "rgba32f";
    case pixel_format::rgb10a2:
        return "rgb10a2";
    case pixel_format::rg16:
        return "rg16";
    case pixel_format::d32f:
        return "d32f";
    case pixel_format::d24:
        return "d24";
    case pixel_format::rg32ui:
        return "rg32ui";
    }
    return "unknown";
}
}
