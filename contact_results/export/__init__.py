"""Export of runs to other programs: ParaView."""
