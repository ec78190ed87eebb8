// Insets on the page about the contacts of an instant: the matrix of their problem, and which side
// of "either a force or an acceleration" each is on.
#pragma once

#include "app/record/recording.h"
#include "render/picture.h"

namespace tumble {

/// How wide and high [px] the matrix is on a page of that many pixels.
double matrixSide(const Eigen::Vector2d& page);

/// A of  a = A f + b, normal rows alone, a coloured cell each number, right of the middle of a page
/// of that many pixels; small matrices of short numbers have them printed. Slides SD49, SD56.
void addContactMatrix(const Scene& scene, const Sample& sample, const Eigen::Vector2d& page,
                      Picture& picture);

/// Force against acceleration of each pair that touches, as a dot on the two half-lines that
/// f ≥ 0, a ≥ 0, f a = 0 leave; above right. a is n·p″ of bodies that do not turn, by the forces of
/// the sample. Slides SD51–SD52.
void addEitherOr(const Scene& scene, const Recording& recording, const Sample& sample,
                 const Eigen::Vector2d& page, Picture& picture);

/// n·p″ [m/s²] of each contact of a sample, by the forces that the bodies bear in it.
std::vector<double> contactAccelerations(const Scene& scene, const Sample& sample);

/// A [1/kg] of the contacts of a sample.
MatX contactMatrix(const Scene& scene, const Sample& sample);

}  // namespace tumble
