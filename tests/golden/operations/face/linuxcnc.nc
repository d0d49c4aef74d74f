(program face, LinuxCNC)
(part face, aluminium, 4 mm thick)
(stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T20 H20 D 16 mm: mill-16, end mill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G64 P0.002 Q0
G53 G0 Z0
(operation: face: face)
G64 P0.02 Q0
T20 M6
G54 S4377 M3
G0 X-29 Y-10
G43 H20 Z5
M8
Z1
G1 Z-0.5 F2328
X29
Y0
X-29
Y10
X29
G0 Z5
M9
M5
G53 G0 Z0
M30
