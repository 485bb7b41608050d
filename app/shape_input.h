#pragma once

#include <string>

#include "remodel/airfoil.h"

namespace remodel::app {

// A SHAPE with its fit errors: those of the table for a catalogue name, zero for a .json file of
// coefficients, those of a fit of the degree for everything else. Throws Error as load_airfoil() does.
CstFit fit_shape(const std::string& shape, int degree);

}  // namespace remodel::app
