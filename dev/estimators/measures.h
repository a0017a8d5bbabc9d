// Monte Carlo measures of the estimators' accuracy, consistency and cost on simulated bearings.
// Each prints its table and compares its results with limits. Deterministic by the number of runs.
#pragma once

#include <string>

#include "dev/estimators/limits.h"

namespace ols::bench {

// One epoch, many geometries: the joint least squares against the Cramer-Rao bound at the truth.
void least_squares_bound(int runs, Limits& limits);

// The filter against the posterior bound, with biases that stay or wander. It runs as usual, and
// also configured for a bias that may stay for hours.
void filter_bounds(int runs, Limits& limits);

// A drone that manoeuvres at 200 to 800 m, with four stations: the filter against the paper's
// estimator. Both are live: each uses only the bearings that have come in by then.
void against_paper(int runs, Limits& limits);

// Crossing targets with misses and false bearings.
void several(int runs, Limits& limits);

// Traffic as detectors see it: ten crossing targets and four staring stations, whose tracklets have
// misses, breaks and false ones. How many targets are found, how often identities change, and how
// many ghosts there are per hour.
void traffic(int runs, Limits& limits);

// A target that detectors find, with automatic hand-over. How long until it is confirmed, and until
// the turning stations have taken it over from an overview station.
void handover(int runs, Limits& limits);

// Meteors, which no drone's recording stands for: 0.3 to 5 s of 10 to 70 km/s at 80 to 200 km, 2 to
// 6 cameras that state nothing but their noise. The recorded filter and its smoother against least
// squares at the same instants.
void meteors(int runs, Limits& limits);

// Stations that have no errors but noise, and state nothing else. So all that the filter allows for
// other errors only costs accuracy. A manoeuvring drone for 12 s; 2, 3, 4, 12 and 100 stations on a
// circle of 250 m at 15 Hz. The recorded filter and its smoother against least squares at the same
// instants. Also, without a limit, a drone that hardly manoeuvres, at 30 Hz.
void noise_only(int runs, Limits& limits);

// Which class simulated objects of known class are assigned after ten seconds, by their size in
// pixels. The tracks have errors, and another seed than those of central/classify/class_table.h.
void classes(int runs, Limits& limits);
// The true features of simulated tracks, as dev/python/ols_class_table.py reads them.
void write_class_looks(const std::string& file, int runs);

// The fusion's processor time per bearing, one line for each site. Up to 1000 stations, eight on a
// target; and up to 100 stations that are all on the same target or targets.
void cost(Limits& limits);

}  // namespace ols::bench
