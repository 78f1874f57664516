// SPDX-License-Identifier: Apache-2.0
// Declares the figures of the page. Each consists of pictures and of texts. The texts contain numbers that are
// counted while drawing.
#pragma once

#include "figures/page.hpp"

namespace riis::figures {

Figure bezier_figure();
Figure coons_figure();
Figure aortic_valve_figure();
Figure aortic_cusp_figure();
Figure mitral_curves_figure();
Figure mitral_surfaces_figure();
Figure mitral_quads_figure();
Figure marking_figure();
Figure tolerance_figure();
Figure accuracy_figure();
Figure accuracy_distribution_figure();

}  // namespace riis::figures
