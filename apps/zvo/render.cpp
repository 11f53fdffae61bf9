#include "render.h"
namespace zvo::cli
{
void render(const RenderOptions&) {}
} // namespace zvo::cli
