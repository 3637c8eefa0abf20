#pragma once

#include <filesystem>
#include <string>

namespace trailcast::sim {

// A place as given on a command line.
struct PlaceOptions {
  std::string world;            // a built-in place's name, or a world file (.obj, .glb, ...)
  std::filesystem::path path;   // way-points x_m,y_m; empty for the built-in place's own
  std::string up = "z";         // the vertical axis of a world file: y or z
  double scale = 1.0;           // metres per unit of a world file
  std::string ground = "mesh";  // the surface robots stand on: mesh or flat
};

}  // namespace trailcast::sim
