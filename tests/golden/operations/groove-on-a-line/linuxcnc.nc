(program groove-on-a-line, LinuxCNC)
(part groove-on-a-line, aluminium, 4 mm thick)
(stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T24 H24 D 6 mm: mill-6, end mill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G64 P0.002 Q0
G53 G0 Z0
(operation: groove: slot)
T24 M6
G54 S11671 M3
G0 X-30 Y-5
G43 H24 Z5
M8
Z1
G1 Z0 F1750
X-10.8993 Z-1 F880
X-30 Z-2
X0 F1750
G3 X9.3204 Y1.3764 I-0.0008 J10.0012
G2 X0 Y-5 I-9.3212 J3.6248
G1 X-30
G0 Z5
M9
M5
G53 G0 Z0
M30
