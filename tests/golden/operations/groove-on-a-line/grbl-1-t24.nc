(program groove-on-a-line-1-t24, Grbl 1.1)
(part groove-on-a-line, aluminium, 4 mm thick)
(stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(file 1 of 1, load T24 mill-6, touch it off on the stock)
(as Z0)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T24 D 6 mm: mill-6, end mill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G53 G0 Z-2
(operation: groove: slot)
T24
G54 S11671 M3
G0 X-30 Y-5
G49
Z5
M8
Z1
G1 Z0 F1750
X-10.899 Z-1 F880
X-30 Z-2
X0 F1750
G3 X9.32 Y1.376 I-0.001 J10.001
G2 X0 Y-5 I-9.321 J3.625
G1 X-30
G0 Z5
M9
M5
G53 G0 Z-2
M30
