// The bits of a run in a few numbers a sample, so that two runs can be held against each other.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/record/recording.h"

namespace tumble {

/// One sample in three numbers. With h_i the hash of body i's x, q, v, ω (and R, where the scene
/// integrates it):
///   state = Σ h_i,   place = Σ (i + 1) h_i   (mod 2⁶⁴)
/// so that of two samples that differ in one body alone, place − place′ = (i + 1) (state − state′)
/// tells which. `forces` is the hash of contacts and joints. All by FNV-1a over little-endian
/// doubles; −0 counts as 0, and q as −q.
struct SampleHash {
  double t = 0.0;  ///< [s]
  std::uint64_t state = 0, place = 0, forces = 0;
};
SampleHash hashOf(const Sample& sample);

/// A run in numbers: what ran, its samples, its events.
struct RunHashes {
  std::string scene;        ///< its name, for people
  double rate = 60.0;       ///< [1/s]
  std::size_t bodies = 0;   ///< of the scene, fixed ones too
  std::uint64_t names = 0;  ///< hash of their names
  std::vector<SampleHash> samples;
  std::size_t eventCount = 0;
  std::uint64_t events = 0;  ///< hash of them all
};

/// Those of a run that has yet to begin.
RunHashes hashesFor(const Scene& scene, double rate);

/// Enters the events that the run ended with.
void addEvents(RunHashes& hashes, const Report& report);

/// The file of hashes: a line of format and version, one of the rate and bodies, "t state place
/// forces" for each sample, and last the events.
std::string hashText(const RunHashes& hashes);

/// Reads such a text for a scene. @param path names it in errors
/// @throws FileError "path:line:column: …" for what is none, of another version or scene, or cut
/// off.
RunHashes readHashes(const std::string& text, const std::string& path, const Scene& scene);

/// Where two runs of a scene part first, in words with the time; nothing if they are the same.
std::optional<std::string> firstDifference(const RunHashes& expected, const RunHashes& actual,
                                           const Scene& scene);

}  // namespace tumble
