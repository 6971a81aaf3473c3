"""What was written, in the formats of other programs: MATLAB, Excel, ParaView."""
