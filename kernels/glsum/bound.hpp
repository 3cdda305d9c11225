// The error bound that every kernel promises: the number that its test enforces.
#pragma once

#include "glsum/error_bound.hpp"
#include "glsum/exponentials/integrator_bound.hpp"
#include "glsum/exponentials/modes_bound.hpp"
#include "glsum/logmemory/nested_bound.hpp"
#include "glsum/window/window_bound.hpp"
#include "glsum/wrap/delta_bound.hpp"
#include "glsum/wrap/tail_bound.hpp"
