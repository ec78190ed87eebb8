// The kinds of context built into this program, and how their functions are loaded.
#pragma once

#include <memory>
#include <string>

#include "render/context/context.h"

namespace tumble {

std::unique_ptr<Context> makeOsmesaContext();  ///< @throws NoContext
std::unique_ptr<Context> makeEglContext();     ///< @throws NoContext

/// Asks Mesa for its software rasteriser with a vector width it is stable at.
/// Call before the process makes its first context; variables that are already set win,
/// but for a width of 512 bits, at which llvmpipe 22 crashes.
void chooseRasteriser();

/// Finds the OpenGL functions of the context that is current, unless `owner` was the last to do so.
/// @param find  the window system's own look-up, such as OSMesaGetProcAddress
/// @throws NoContext if the context offers less than OpenGL 3.3.
using FindFunction = void (*(*)(const char* name))();
void loadFunctions(const Context& owner, FindFunction find);
/// Tells that `owner` is gone: the next context loads its functions afresh.
void forgetFunctions(const Context& owner);

}  // namespace tumble
