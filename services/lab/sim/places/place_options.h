#pragma once

#include <filesystem>
#include <string>

namespace trailcast::sim {

// Places by the words of a command line.
struct PlaceOptions {
  std::string world;            // a built-in place's name, or a world file (.obj, .glb, ...)
  std::filesystem::path path;   // x_m,y_m way-points; empty: the built-in place's own
  std::string up = "z";         // of a world file: y or z
  double scale = 1.0;           // metres per unit of a world file
  std::string ground = "mesh";  // what robots stand on: mesh or flat
};

}  // namespace trailcast::sim
