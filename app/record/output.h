// A recording as text: the files that `simulate` writes and goldens are compared with.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/file/file.h"
#include "app/record/recording.h"

namespace tumble {

/// t,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz – a row per moving body and sample. World frame, SI.
/// Points of what bends are bodies here; of a fur those of every fiftieth strand.
std::string trajectoryCsv(const Recording& recording, const Scene& scene);

/// t,kind,a,b,px,py,pz,nx,ny,nz,vrel,j – a row per event.
std::string eventsCsv(const Recording& recording, const Scene& scene);

/// t,a,b,px,py,pz,nx,ny,nz,separation,fx,fy,fz – a row per contact point and sample; force on a
/// [N].
std::string contactsCsv(const Recording& recording, const Scene& scene);

/// t,joint,a,b,px,py,pz,fx,fy,fz,tx,ty,tz – a row per joint and sample: force [N] and torque [N m]
/// on a, about the anchor p; b is empty for the world.
std::string jointsCsv(const Recording& recording, const Scene& scene);

/// The certificate as JSON with flat keys.
std::string summaryJson(const Recording& recording, const Scene& scene);

/// A text as a field of a CSV file, in quotes (RFC 4180).
std::string csvQuoted(const std::string& text);

/// Writes trajectory.csv, events.csv, contacts.csv, summary.json and, if there are joints,
/// joints.csv into a folder while the run goes on, so that it need not be kept. Files appear when
/// they are complete. Points of what bends stand in a file of their own, nodes.csv, if it is asked
/// for:  t,body,x,y,z,vx,vy,vz.
class OutputFiles {
 public:
  /// Makes the folder if need be.
  /// @throws FileError
  OutputFiles(const std::string& folder, const Scene& scene, bool nodes = false);

  /// The next sample. @throws FileError
  void add(const Sample& sample);
  /// What is known at the end: events and certificate. @throws FileError
  void finish(const Recording& recording);

 private:
  std::string folder_;
  const Scene& scene_;
  FileWriter trajectory_, contacts_;
  std::optional<FileWriter> joints_, nodes_;
  std::vector<char> points_;  ///< per body whether it is a point of what bends
  std::string text_;          ///< scratch
};

}  // namespace tumble
