// Chapter 7, contact: whether the contacts of one pair can carry a load within their laws.
#pragma once

#include <span>

#include "sim/contact/contact.h"

namespace tumble {

/// Whether there are contact forces with the same sum and the same moment as those that the
/// contacts of a pair carry, each within its law:  f_n ≥ 0;  |f_t| ≤ mu f_n of one that sticks,
/// f_t = −mu f_n slip/|slip| of one that slides,  f = 0 of one that idles. Where contacts are more
/// than needed, forces that break their laws may stand for others, with the same motion, that keep
/// them.
/// @param contacts  of a against b, followed to the poses of the two bodies
/// @param off  [m/s²] by which accelerations of the two may differ, points of them included
bool canCarry(const RigidBody& a, const RigidBody& b, std::span<const Contact> contacts,
              double off);

}  // namespace tumble
