// What the table of claims is filled with.
#pragma once

#include "app/claim/claim.h"

namespace tumble {

std::vector<ClaimRow> bounceApexRows(const Scene&, const Recording&);
std::vector<Curve> bouncePaths(const Scene&, const Recording&);
std::vector<ClaimRow> bouncingRows(const Scene&, const Recording&);
std::vector<ClaimRow> restTimeRows(const Scene&, const Recording&);
std::vector<ClaimRow> firstHitRows(const Scene&, const Recording&);
std::vector<ClaimRow> arcRows(const Scene&, const Recording&);
std::vector<Curve> arcPaths(const Scene&, const Recording&);
std::vector<ClaimRow> orbitRows(const Scene&, const Recording&);
std::vector<Curve> orbitPaths(const Scene&, const Recording&);
std::vector<ClaimRow> towerRows(const Scene&, const Recording&);
std::vector<ClaimRow> weightRows(const Scene&, const Recording&);
std::vector<ClaimRow> freeSpinRows(const Scene&, const Recording&);
std::vector<ClaimRow> flipRows(const Scene&, const Recording&);
std::vector<ClaimRow> topRows(const Scene&, const Recording&);
std::vector<ClaimRow> planRows(const Scene&, const Recording&);
std::vector<ClaimRow> pointPlanRows(const Scene&, const Recording&);
std::vector<ClaimRow> holdRows(const Scene&, const Recording&);
std::vector<ClaimRow> springContactRows(const Scene&, const Recording&);
std::vector<ClaimRow> rowOfBallsRows(const Scene&, const Recording&);
std::vector<ClaimRow> leverRows(const Scene&, const Recording&);
std::vector<ClaimRow> grooveRows(const Scene&, const Recording&);
std::vector<ClaimRow> apartRows(const Scene&, const Recording&);
std::vector<ClaimRow> slidingRows(const Scene&, const Recording&);
std::vector<ClaimRow> wayRows(const Scene&, const Recording&);
std::vector<ClaimRow> bookRows(const Scene&, const Recording&);
std::vector<ClaimRow> crowdRows(const Scene&, const Recording&);
std::vector<ClaimRow> equilibriumRows(const Scene&, const Recording&);
std::vector<ClaimRow> settledRows(const Scene&, const Recording&);
std::vector<ClaimRow> topplingRows(const Scene&, const Recording&);
std::vector<ClaimRow> spinRows(const Scene&, const Recording&);

}  // namespace tumble
