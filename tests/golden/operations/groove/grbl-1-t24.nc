(program groove-1-t24, Grbl 1.1)
(part groove, aluminium, 4 mm thick)
(stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000)
(origin: axis of the part, Z0 on top of the stock)
(file 1 of 1, load T24 mill-6, touch it off on the stock)
(as Z0)
(origin G54, Z0 on top of the stock, units mm and mm/min)
(T24 D 6 mm: mill-6, end mill)
G17 G21 G40 G49 G80 G90 G91.1 G94
G53 G0 Z-2
(operation: groove: rough)
T24
G54 S11671 M3
G0 X-23.026 Y-3.959
G49
Z5
M8
Z1
G1 Z-2 F2625
G2 X-20 Y-1.8 I3.043 J-1.065 F1750
G1 X20
G2 X23.026 Y-3.959 I-0.017 J-3.224
G1 Y3.959 F5000
G2 X20 Y1.8 I-3.043 J1.065 F1750
G1 X-20
G2 X-23.026 Y3.959 I0.017 J3.224
G0 Z5
(operation: groove: finish)
X-23.002 Y-5.043
Z1
G1 Z-2 F3501
G2 X-20 Y-1.998 I3.003 J0.042
G1 X20
G2 X23.002 Y-5.043 I-0.001 J-3.003
G0 Z5
X-23.002
Z1
G1 Z-2
G2 X-20 Y-1.998 I3.003 J0.042
G1 X20
G2 X23.002 Y-5.043 I-0.001 J-3.003
G0 Z5
Y5.043
Z1
G1 Z-2
G2 X20 Y1.998 I-3.003 J-0.042
G1 X-20
G2 X-23.002 Y5.043 I0.001 J3.003
G0 Z5
X23.002
Z1
G1 Z-2
G2 X20 Y1.998 I-3.003 J-0.042
G1 X-20
G2 X-23.002 Y5.043 I0.001 J3.003
G0 Z5
M9
M5
G53 G0 Z-2
M30
