(program face-1-t20, Grbl 1.1)
(part face, aluminium, 4 mm thick)
(stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(file 1 of 1, load T20 mill-16, touch it off on the stock)
(as Z0)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T20 D 16 mm: mill-16, end mill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G53 G0 Z-2
(operation: face: face)
T20
G54 S4377 M3
G0 X-29 Y-10
G49
Z5
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
G53 G0 Z-2
M30
