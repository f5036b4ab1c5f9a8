"""What `emogen rig pack` hands to artists and actors: cards, a sheet, tables."""
