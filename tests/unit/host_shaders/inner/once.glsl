#ifdef __cplusplus
#include <cstdint>
#endif
/* A block; with "quotes" [ and
 * #include "missing.glsl"
 */
int twice(int x)
{
    return DOUBLED * x;
}
