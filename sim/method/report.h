// Chapter 9, method: what a run says of itself. Numerical outcomes are reported, never thrown.
#pragma once

#include <iterator>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "sim/math/vec.h"

namespace tumble {

enum class EventKind { Impact, Rest, Separate, Slip, Stick };

/// "impact", "rest", "separate", "slip" or "stick".
const char* eventName(EventKind kind);

/// Something that happened between two bodies; b stands first in the scene. World frame, SI.
struct Event {
  double t = 0.0;
  EventKind kind = EventKind::Impact;
  int a = 0, b = 0;
  Vec3 p = Vec3::Zero(), n = Vec3::UnitY();  ///< n out of b towards a
  /// [m/s] most negative n·(ṗa − ṗb) before; of springs, when they set in or end
  double vrel = 0.0;
  double j = 0.0;  ///< [N·s] sum of normal impulses
};

/// The certificate that every run ends with. SI.
struct Certificate {
  long steps = 0, events = 0;
  long evaluations = 0;            ///< of the forces on all bodies; a Taylor jet counts its order
  long plane_tests = 0;            ///< looks at a pair that was near
  long plane_hits = 0;             ///< of these, answered by a plane that parted it before
  double max_penetration = 0.0;    ///< [m] max(0, −separation)
  double mesh_excess = 0.0;        ///< [m] how far pieces stand out of their mesh at most
  double max_joint_gap = 0.0;      ///< [m] how far a joint was from being met
  long cloth_crossings = 0;        ///< most edges through triangles of cloth at one of its looks
  long hits_early = 0;             ///< contacts struck before they met, as of a crowd
  double max_hit_shift = 0.0;      ///< [s] the longest before
  double energy_cut_impact = 0.0;  ///< [J] that restitution would have given beyond what there was
  long islands_solved = 0;         ///< island-steps solved to the tolerance asked for,
  long islands_rough = 0;          ///< and those of crowds in motion, solved as far as is planned
  long islands_kept = 0;           ///< and those that asked nothing new: their answer stayed
  double max_closed_height = 0.0;  ///< [m] of bounces that were left out
  double max_complementarity = 0.0;  ///< worst natural-map residual of a contact problem, relative
  double energy_start = 0.0, energy_end = 0.0;                  ///< [J]
  double energy_lost_impact = 0.0, energy_lost_friction = 0.0;  ///< [J]
  double energy_lost_bending = 0.0;  ///< [J] in dampers of what bends, and in its implicit steps
  double energy_added_repair = 0.0;  ///< [J] by moving bodies out of each other
  double spin_added_repair = 0.0;    ///< [kg m²/s] that this gave what no fixed body held, at most
  double max_energy_gain = 0.0;      ///< [J] largest rise that neither repairs nor forces gave
  double work_of_forces = 0.0;  ///< [J] by forces without a potential and by moving fixed bodies
  /// |E_end − E_start + lost − added − work| / max kinetic, and worst |P − P₀ − ∫F − Σ impulses| /
  /// max Σ|P|. Of a scene at rest, with less than a millionth of that: by the ½ Σ (F t)²/m and the
  /// Σ |F| t that its loads F would give it if nothing held it.
  double energy_balance_error = 0.0, momentum_error = 0.0;

  // What `audit/` finds from recorded states alone, beside what is told above.
  long audited_steps = 0;           ///< parts between two recorded states
  long audit_untold_steps = 0;      ///< of these, ones of which states do not tell the energy
  double audit_energy_gain = 0.0;   ///< [J] largest rise of energy beyond the work of loads
  double audit_energy_error = 0.0;  ///< as energy_balance_error, with that work; 0 if untold
  double audit_momentum_error = 0.0, audit_spin_error = 0.0;  ///< relative, of what nothing holds
  double audit_max_penetration = 0.0;                         ///< [m] at the end of any part
  double audit_penetration_between = 0.0;                     ///< [m] in the midst of any part
  double audit_joint_gap = 0.0;                               ///< [m]

  /// Takes in what bodies did beside others: counts and energies add up, of each `max_` the larger
  /// stays.
  void add(const Certificate& part);
};

/// A number of the certificate and its key in summary.json and in tables.
struct CertificateField {
  const char* key;
  std::variant<long Certificate::*, double Certificate::*> number;
};

inline constexpr CertificateField kCertificateFields[] = {
    {"steps", &Certificate::steps},
    {"events", &Certificate::events},
    {"evaluations", &Certificate::evaluations},
    {"plane_tests", &Certificate::plane_tests},
    {"plane_hits", &Certificate::plane_hits},
    {"max_penetration", &Certificate::max_penetration},
    {"mesh_excess", &Certificate::mesh_excess},
    {"max_joint_gap", &Certificate::max_joint_gap},
    {"cloth_crossings", &Certificate::cloth_crossings},
    {"hits_early", &Certificate::hits_early},
    {"max_hit_shift", &Certificate::max_hit_shift},
    {"energy_cut_impact", &Certificate::energy_cut_impact},
    {"islands_solved", &Certificate::islands_solved},
    {"islands_rough", &Certificate::islands_rough},
    {"islands_kept", &Certificate::islands_kept},
    {"max_closed_height", &Certificate::max_closed_height},
    {"max_complementarity", &Certificate::max_complementarity},
    {"energy_start", &Certificate::energy_start},
    {"energy_end", &Certificate::energy_end},
    {"energy_lost_impact", &Certificate::energy_lost_impact},
    {"energy_lost_friction", &Certificate::energy_lost_friction},
    {"energy_lost_bending", &Certificate::energy_lost_bending},
    {"energy_added_repair", &Certificate::energy_added_repair},
    {"spin_added_repair", &Certificate::spin_added_repair},
    {"max_energy_gain", &Certificate::max_energy_gain},
    {"work_of_forces", &Certificate::work_of_forces},
    {"energy_balance_error", &Certificate::energy_balance_error},
    {"momentum_error", &Certificate::momentum_error},
    {"audited_steps", &Certificate::audited_steps},
    {"audit_untold_steps", &Certificate::audit_untold_steps},
    {"audit_energy_gain", &Certificate::audit_energy_gain},
    {"audit_energy_error", &Certificate::audit_energy_error},
    {"audit_momentum_error", &Certificate::audit_momentum_error},
    {"audit_spin_error", &Certificate::audit_spin_error},
    {"audit_max_penetration", &Certificate::audit_max_penetration},
    {"audit_penetration_between", &Certificate::audit_penetration_between},
    {"audit_joint_gap", &Certificate::audit_joint_gap},
};
static_assert(sizeof(Certificate) == sizeof(double) * std::size(kCertificateFields),
              "every number of the certificate has its key");

/// A pose that a step of `course` led a body to although it overlaps another one there, and what
/// the plan made of it: where it then stood, or stood free again.
struct Misstep {
  double t = 0.0;  ///< [s]
  int body = 0, other = 0;
  double separation = 0.0;  ///< [m] < 0
  Pose pose;
  double mendedAt = std::numeric_limits<double>::infinity();  ///< [s]; infinite: not yet
  Pose mended = {};
};

inline constexpr std::size_t kMostMissteps = 100;

/// Where the audit finds more than the certificate says and a stated share allows.
struct Disagreement {
  const char* what;  ///< and its unit
  double found = 0.0, stated = 0.0, allowed = 0.0;
};

/// What a method leaves behind: certificate, events in order of time, and why it stopped if it did.
struct Report {
  Certificate certificate;
  std::vector<Event> events;
  std::vector<Misstep> missteps;            ///< the first kMostMissteps
  bool stopped = false;                     ///< the physics could not go on
  std::string reason;                       ///< one sentence: what, where, when
  std::vector<std::string> notes;           ///< approximations that were taken, once each
  std::vector<Disagreement> disagreements;  ///< of audit and certificate, at the end of a run

  /// Adds a note unless it is there.
  void note(const char* text);
};

}  // namespace tumble
