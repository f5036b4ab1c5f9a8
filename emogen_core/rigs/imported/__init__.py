"""From a head model of somebody else to a rig, and a look for it, with which a study can be run."""
