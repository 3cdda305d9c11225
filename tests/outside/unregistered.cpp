// What the library has no body of: refused by the compiler, in one line.
#include <glsum/registry.hpp>

glsum::Line<glsum::Sum<glsum::Shift, glsum::Compensated, glsum::F64>, 8> line;
